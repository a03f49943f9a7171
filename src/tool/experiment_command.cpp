// experiment table1, figure4: the simulations of Garg et al. 2016, rerun.
#include <cmath>
#include <cstdio>
#include <map>
#include <mutex>

#include "palpation/base/error.h"
#include "palpation/base/parallel.h"
#include "palpation/io/atomic_file.h"
#include "tool/commands.h"
#include "tool/episode.h"
#include "tool/output_folder.h"
#include "tool/progress.h"
#include "tool/setup.h"
#include "tool/words.h"
#include "tool/worlds.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

/// One cell of a table: a scene, and what the paper prints for it.
struct Cell {
  std::string shape, row, algorithm, level;
  Scene scene;
  std::optional<double> printed;
};

/// The paper's phantom and model, with the constants of the authors' public code: GPy's squared exponential of variance 25 (z-scored
/// readings), likelihood variance 1, a constant of variance 52.
json paper_scene() {
  return {{"version", 1},
          {"surface", {{"plane", {{"size_mm", {25, 50}}, {"vertices", {200, 200}}}}}},
          {"field",
           {{"metric", "chart"},
            {"kernel", "squared-exponential"},
            {"length_mm", 3.3},
            {"signal_sd", 5},
            {"noise_to_signal", 0.2},
            {"trend", "constant"},
            {"constant_sd", 7.211102550927978},
            {"standardize", true}}},
          {"level", {{"estimate", "known"}, {"value", 8}, {"fraction", 0.5}}},
          {"plan",
           {{"acquisition", "ils-ucb"},
            {"gamma", 0.5},
            {"scaling", "max"},
            {"initial", {{"design", "random"}, {"count", 5}}},
            {"batch", 10},
            {"batches", 10},
            {"least_spacing_mm", 0}}},
          {"probe",
           {{"kind", "simulated"},
            {"low", 7},
            {"high", 9},
            {"slope_per_m", 1400},
            {"noise", 0.01},
            {"bias", 0},
            {"bias_axis", {0, 1, 0}},
            {"tumours", json::array()}}},
          {"seed", 0}};
}

json shape_json(const std::string& shape) {
  if (shape == "disk") return json::array({{{"shape", "disk"}, {"centre_mm", {11.492, 30, 0}}, {"radius_mm", 6.25}}});
  return json::array({{{"shape", "horseshoe"},
                       {"centre_mm", {9.492, 20, 0}},
                       {"arc_radius_mm", 7},
                       {"half_width_mm", 2.5},
                       {"arc_deg", 180},
                       {"facing", {1, 0, 0}}}});
}

const std::vector<std::string> kShapes = {"disk", "horseshoe"};
const std::vector<std::string> kAlgorithms = {"evr", "ucb", "ils-ucb"};

/// Table I as printed, in % of the search area: shape, row, algorithm. The bias rows beyond 1 % are lost.
std::optional<double> printed_value(const std::string& shape, const std::string& row, const std::string& algorithm) {
  static const std::map<std::string, std::vector<double>> rows = {{"noise 1 %", {.840, .567, .056, 1.467, 1.001, .175}},
                                                                  {"noise 5 %", {.807, .672, .177, 1.525, 1.256, .373}},
                                                                  {"noise 10 %", {1.189, .951, .393, 2.155, 2.135, .749}},
                                                                  {"noise 25 %", {2.610, 2.870, 1.314, 3.987, 5.116, 2.210}},
                                                                  {"bias 1 %", {.759, .573, .060, 1.255, 1.093, .141}}};
  const auto found = rows.find(row);
  if (found == rows.end()) return std::nullopt;
  const std::size_t algorithm_index = algorithm == "evr" ? 0 : algorithm == "ucb" ? 1 : 2;
  return found->second[(shape == "disk" ? 0 : 3) + algorithm_index];
}

Scene base_scene(const ExperimentArguments& arguments) {
  if (!arguments.scene.empty()) return Scene::read(arguments.scene, arguments.overrides);
  return Scene(paper_scene(), "experiment " + arguments.name, ".").with_overrides(arguments.overrides);
}

std::vector<Cell> table_cells(const Scene& base, bool keep_tumours) {
  std::vector<Cell> cells;
  const auto add = [&](const std::string& level, const std::string& row, double noise, double bias) {
    for (const std::string& shape : keep_tumours ? std::vector<std::string>{"the scene's"} : kShapes) {
      for (const std::string& algorithm : kAlgorithms) {
        Scene scene =
            base.with("probe.noise", noise).with("probe.bias", bias).with("plan.acquisition", algorithm).with("level.estimate", level);
        if (!keep_tumours) scene = scene.with("probe.tumours", shape_json(shape));
        cells.push_back({shape, row, algorithm, level, scene, printed_value(shape, row, algorithm)});
      }
    }
  };
  for (const std::string level : {"known", "range"}) {
    for (const int percent : {1, 5, 10, 25}) add(level, "noise " + std::to_string(percent) + " %", percent / 100.0, 0.0);
    for (const int percent : {1, 5, 50, 100}) add(level, "bias " + std::to_string(percent) + " %", 0.01, percent / 100.0);
  }
  return cells;
}

struct Statistics {
  double mean = 0.0;
  std::optional<double> standard_error{};  ///< nothing for a single trial
};

Statistics statistics(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  Statistics result;
  for (double value : values) result.mean += value / n;
  double square = 0.0;
  for (double value : values) square += (value - result.mean) * (value - result.mean);
  if (n > 1.0) result.standard_error = std::sqrt(square / (n - 1.0) / n);
  return result;
}

/// The error of every batch of every trial, in % of the search area: [cell][trial][batch].
using Errors = std::vector<std::vector<std::vector<double>>>;

Errors run_trials(const std::vector<Cell>& cells, const Surface& surface, const ExperimentArguments& arguments) {
  Errors errors(cells.size(), std::vector<std::vector<double>>(static_cast<std::size_t>(arguments.trials)));
  const int runs = static_cast<int>(cells.size()) * arguments.trials;
  Progress progress("Runs", runs, arguments.quiet);
  std::mutex progress_guard;
  int done = 0;
  for_ranges(runs, 1, [&](int first, int last) {
    for (int run = first; run < last; ++run) {
      const std::size_t cell = static_cast<std::size_t>(run / arguments.trials);
      const int trial = run % arguments.trials;
      const Scene scene = cells[cell].scene.with("seed", arguments.first_seed + static_cast<std::uint64_t>(trial));
      const World world = simulated_world(scene, surface);
      const Episode episode = run_episode(scene, surface, world);
      for (const TraceRow& row : episode.trace) {
        errors[cell][trial].push_back(row.error ? 100.0 * row.error->symmetric_difference_m2 / surface.area() : 100.0);
      }
      const std::lock_guard lock(progress_guard);
      if (++done % std::max(1, runs / 100) == 0 || done == runs) progress.step(done, "");
    }
  });
  return errors;
}

std::vector<double> finals(const std::vector<std::vector<double>>& trials) {
  std::vector<double> values;
  for (const auto& trial : trials) values.push_back(trial.back());
  return values;
}

void report_table(const std::vector<Cell>& cells, const Errors& errors, const ExperimentArguments& arguments) {
  std::string csv = "level,row,shape,algorithm,trials,error_percent,standard_error,printed\n";
  std::string level;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& cell = cells[i];
    const Statistics result = statistics(finals(errors[i]));
    if (cell.level != level) {
      level = cell.level;
      std::printf(
          "\n%s\nSymmetric difference, %% of the search area: mean +- standard error of %d trials (printed in the paper)\n",
          level == "known" ? "Level known beforehand (the authors' code)" : "Level from the greatest and least mean (the paper's text)",
          arguments.trials);
    }
    if (cell.algorithm == "evr") std::printf("%-12s%-12s", cell.row.c_str(), cell.shape.c_str());
    const std::string spread = result.standard_error ? fixed(*result.standard_error, 3) : "-";
    std::printf("  %-8s%7.3f +- %-5s (%s)", cell.algorithm.c_str(), result.mean, spread.c_str(),
                cell.printed ? fixed(*cell.printed, 3).c_str() : "  -  ");
    if (cell.algorithm == "ils-ucb") std::printf("\n");
    csv += cell.level + "," + cell.row + "," + cell.shape + "," + cell.algorithm + "," + std::to_string(arguments.trials) + "," +
           text_of(result.mean) + "," + (result.standard_error ? text_of(*result.standard_error) : "") + "," +
           (cell.printed ? text_of(*cell.printed) : "") + "\n";
  }
  if (!arguments.out.empty()) write_atomically(arguments.out / "table1.csv", csv);
}

std::vector<Cell> figure_cells(const Scene& base, bool keep_tumours) {
  std::vector<Cell> cells;
  for (const int percent : {5, 25}) {
    for (const std::string& algorithm : kAlgorithms) {
      Scene scene = base.with("probe.noise", percent / 100.0).with("plan.acquisition", algorithm);
      if (!keep_tumours) scene = scene.with("probe.tumours", shape_json("horseshoe"));
      cells.push_back({"horseshoe", std::to_string(percent), algorithm, "known", scene, std::nullopt});
    }
  }
  return cells;
}

void report_figure(const std::vector<Cell>& cells, const Errors& errors, const Scene& base, const ExperimentArguments& arguments) {
  const int initial = base.integer("plan.initial.count");
  const int batch = base.integer("plan.batch");
  for (std::size_t first = 0; first < cells.size(); first += kAlgorithms.size()) {
    std::string csv = "readings";
    for (const std::string& algorithm : kAlgorithms) csv += "," + algorithm + "," + algorithm + "_se";
    csv += "\n";
    std::printf("\nHorseshoe, noise %s %%: symmetric difference in %% of the search area, mean of %d trials\n%s", cells[first].row.c_str(),
                arguments.trials, csv.c_str());
    for (std::size_t step = 0; step < errors[first].front().size(); ++step) {
      std::string line = std::to_string(initial + batch * static_cast<int>(step));
      for (std::size_t i = first; i < first + kAlgorithms.size(); ++i) {
        std::vector<double> values;
        for (const auto& trial : errors[i]) {
          if (step < trial.size()) values.push_back(trial[step]);
        }
        const Statistics result = statistics(values);
        line += "," + text_of(result.mean) + "," + (result.standard_error ? text_of(*result.standard_error) : "");
      }
      std::printf("%s\n", line.c_str());
      csv += line + "\n";
    }
    if (arguments.out.empty()) continue;
    const std::string name = "figure4_noise_" + cells[first].row;
    write_atomically(arguments.out / (name + ".csv"), csv);
    const auto no_picture = run_draw({"--curves", (arguments.out / (name + ".csv")).string(), (arguments.out / (name + ".png")).string(),
                                      "--log-y", "--title", "Horseshoe, noise " + cells[first].row + " % of the range", "--x-label",
                                      "readings", "--y-label", "symmetric difference, % of the search area"});
    if (no_picture) std::fprintf(stderr, "palpate: no picture: %s\n", no_picture->c_str());
  }
}

}  // namespace

void experiment(const ExperimentArguments& arguments) {
  const Scene base = base_scene(arguments);
  const bool keep_tumours = !arguments.scene.empty();
  const bool table = arguments.name == "table1";
  const std::vector<Cell> cells = table ? table_cells(base, keep_tumours) : figure_cells(base, keep_tumours);
  if (arguments.print_scene) {
    json all = json::array();
    for (const Cell& cell : cells) {
      all.push_back(
          {{"cell", cell.row + ", " + cell.shape + ", " + cell.algorithm + ", level " + cell.level}, {"scene", cell.scene.given()}});
    }
    std::printf("%s\n", all.dump(2, ' ', false, json::error_handler_t::replace).c_str());
    return;
  }
  if (!arguments.out.empty()) make_folder(arguments.out);
  const Tissue tissue = tissue_of(base);
  const Errors errors = run_trials(cells, tissue.surface, arguments);
  if (table) {
    report_table(cells, errors, arguments);
  } else {
    report_figure(cells, errors, base, arguments);
  }
}

}  // namespace palpation::tool
