// experiment table1: the simulations of Garg et al. 2016, rerun.
#include <algorithm>
#include <cstdio>
#include <map>

#include "experiments/experiment.h"
#include "experiments/paper_scene.h"
#include "palpation/base/error.h"
#include "palpation/boundary/level_set.h"
#include "palpation/certainty/reference_bound.h"
#include "scene/tissue.h"
#include "scene/worlds.h"

namespace palpation::tool {
namespace {

/// Where a cell stands in the table.
struct Entry {
  std::string shape, row, algorithm, level;
  std::optional<double> printed;  ///< in the paper
};

struct Table {
  std::vector<Entry> entries;
  std::vector<Cell> cells;  ///< one per entry
};

/// Table I as printed, in % of the search area: shape, row, algorithm. The bias rows beyond 1 % are
/// lost.
std::optional<double> printed_value(const std::string& shape, const std::string& row,
                                    const std::string& algorithm) {
  static const std::map<std::string, std::vector<double>> rows = {
      {"noise 1 %", {.840, .567, .056, 1.467, 1.001, .175}},
      {"noise 5 %", {.807, .672, .177, 1.525, 1.256, .373}},
      {"noise 10 %", {1.189, .951, .393, 2.155, 2.135, .749}},
      {"noise 25 %", {2.610, 2.870, 1.314, 3.987, 5.116, 2.210}},
      {"bias 1 %", {.759, .573, .060, 1.255, 1.093, .141}}};
  const auto found = rows.find(row);
  if (found == rows.end()) return std::nullopt;
  const std::size_t algorithm_index = algorithm == "evr" ? 0 : algorithm == "ucb" ? 1 : 2;
  return found->second[(shape == "disk" ? 0 : 3) + algorithm_index];
}

Table table_of(const Scene& base, const ExperimentArguments& arguments) {
  const bool keep_tumours = !arguments.scene.empty();
  Table table;
  const auto add = [&](const std::string& level, const std::string& row, double noise,
                       double bias) {
    for (const std::string& shape :
         keep_tumours ? std::vector<std::string>{"the scene's"} : kPaperShapes) {
      for (const std::string& algorithm : kPaperAlgorithms) {
        const std::string name = row + ", " + shape + ", " + algorithm + ", level " + level;
        if (!is_chosen(name, arguments)) continue;
        Scene scene = base.with("probe.noise", noise)
                          .with("probe.bias", bias)
                          .with("plan.acquisition", algorithm)
                          .with("level.estimate", level);
        if (!keep_tumours) scene = scene.with("probe.tumours", paper_tumour(shape));
        table.entries.push_back(
            {shape, row, algorithm, level, printed_value(shape, row, algorithm)});
        table.cells.push_back({name, scene});
      }
    }
  };
  for (const std::string level : {"known", "range"}) {
    for (const int percent : {1, 5, 10, 25})
      add(level, "noise " + std::to_string(percent) + " %", percent / 100.0, 0.0);
    for (const int percent : {1, 5, 50, 100})
      add(level, "bias " + std::to_string(percent) + " %", 0.01, percent / 100.0);
  }
  return table;
}

void report(const std::vector<Entry>& entries, const Errors& errors,
            const ExperimentArguments& arguments) {
  std::string csv = "level,row,shape,algorithm,trials,error_percent,standard_error,printed\n";
  std::string level;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& entry = entries[i];
    const Statistics result = statistics(finals(errors[i]));
    if (entry.level != level) {
      level = entry.level;
      std::printf(
          "\n\n%s\nSymmetric difference, %% of the search area: mean +- standard error of %d "
          "trials (printed in the paper)",
          level == "known" ? "Level known beforehand (the authors' code)"
                           : "Level from the greatest and least mean (the paper's text)",
          arguments.trials);
    }
    if (i == 0 || entry.row != entries[i - 1].row || entry.shape != entries[i - 1].shape ||
        entry.level != entries[i - 1].level)
      std::printf("\n%-12s%-12s", entry.row.c_str(), entry.shape.c_str());
    std::printf("  %-8s%s (%s)", entry.algorithm.c_str(), in_words(result).c_str(),
                or_dash(entry.printed).c_str());
    csv += entry.level + "," + entry.row + "," + entry.shape + "," + entry.algorithm + "," +
           std::to_string(arguments.trials) + "," + text_of(result.mean) + "," +
           or_empty(result.standard_error) + "," + or_empty(entry.printed) + "\n";
  }
  std::printf("\n");
  write_table(arguments, "table1", csv);
}

/// The tool's defaults on the same phantoms, with the level unknown; a trend where there is a bias.
Table default_table(const Scene& base, const ExperimentArguments& arguments) {
  Table table;
  const auto add = [&](const std::string& row, double noise, double bias,
                       const std::string& trend) {
    for (const std::string& shape : kPaperShapes) {
      const std::string name = row + ", " + shape + ", the defaults";
      if (!is_chosen(name, arguments)) continue;
      const Scene scene = base.with("probe.noise", noise)
                              .with("probe.bias", bias)
                              .with("probe.tumours", paper_tumour(shape))
                              .with("field.trend", trend);
      table.entries.push_back(
          {shape, row, "auto", scene.word("level.estimate"), printed_value(shape, row, "ils-ucb")});
      table.cells.push_back({name, scene});
    }
  };
  for (const int percent : {1, 5, 10, 25})
    add("noise " + std::to_string(percent) + " %", percent / 100.0, 0.0, "constant");
  for (const int percent : {1, 5, 50, 100})
    add("bias " + std::to_string(percent) + " %", 0.01, percent / 100.0, "linear");
  return table;
}

/// The bound knows the shape's number of modes, and where its outline runs: a reference for every
/// method.
double bound_percent(const Entry& entry, const Scene& scene, double area_m2) {
  const int readings = scene.integer("plan.initial.count") +
                       scene.integer("plan.batch") * scene.integer("plan.batches");
  const ReferenceBound bound = reference_bound({.perimeter_m = paper_perimeter_m(entry.shape),
                                                .slope_per_m = scene.number("probe.slope_per_m"),
                                                .noise = scene.number("probe.noise"),
                                                .readings = readings,
                                                .fraction = scene.number("level.fraction")});
  return 100.0 * bound.expected_error_m2 / area_m2;
}

void report_defaults(const Table& table, const Errors& errors,
                     const ExperimentArguments& arguments) {
  std::printf(
      "\nLevel unknown, the tool's defaults (trend on in the rows with bias); over half the tumour "
      "wrong: missed\n");
  std::printf(
      "%-12s%-12s  error, %%              (ILS-UCB as printed)  missed reference bound   error / "
      "bound\n",
      "", "");
  std::string csv = "row,shape,trials,error_percent,standard_error,printed,lost,bound_percent\n";
  for (std::size_t i = 0; i < table.entries.size(); ++i) {
    const Entry& entry = table.entries[i];
    const Surface tissue = tissue_of(table.cells[i].scene).surface;
    const World world = simulated_world(table.cells[i].scene, tissue);
    const double half =
        50.0 * superlevel_area(tissue, world.truth, world.true_level) / tissue.area();
    const std::vector<double> last = finals(errors[i]);
    const Statistics result = statistics(last);
    const auto lost =
        std::count_if(last.begin(), last.end(), [&](double error) { return error > half; });
    const double bound = bound_percent(entry, table.cells[i].scene, tissue.area());
    std::printf("%-12s%-12s  %s (%s)  %12ld  %16.3f  %14.2f\n", entry.row.c_str(),
                entry.shape.c_str(), in_words(result).c_str(), or_dash(entry.printed).c_str(),
                static_cast<long>(lost), bound, result.mean / bound);
    csv += entry.row + "," + entry.shape + "," + std::to_string(arguments.trials) + "," +
           text_of(result.mean) + "," + or_empty(result.standard_error) + "," +
           or_empty(entry.printed) + "," + std::to_string(lost) + "," + text_of(bound) + "\n";
  }
  write_table(arguments, "table1_defaults", csv);
}

}  // namespace

void table1(const ExperimentArguments& arguments) {
  const Table table = table_of(base_scene(arguments, paper_scene()), arguments);
  const Table defaults = arguments.scene.empty()
                             ? default_table(base_scene(arguments, default_scene()), arguments)
                             : Table();
  std::vector<Cell> cells = defaults.cells;
  cells.insert(cells.end(), table.cells.begin(), table.cells.end());
  refuse_no_cell(cells.size(), arguments);
  if (printed_scenes(cells, arguments)) return;
  if (!defaults.cells.empty())
    report_defaults(defaults, run_trials(defaults.cells, arguments), arguments);
  if (!table.cells.empty()) report(table.entries, run_trials(table.cells, arguments), arguments);
}

}  // namespace palpation::tool
