// experiment table1: the simulations of Garg et al. 2016, rerun.
#include <algorithm>
#include <cstdio>
#include <map>

#include "experiments/experiment.h"
#include "experiments/lazy_tissue.h"
#include "experiments/paper_scene.h"
#include "palpation/base/error.h"
#include "palpation/boundary/level_set.h"
#include "palpation/certainty/reference_bound.h"
#include "scene/worlds.h"

namespace palpation::tool {
namespace {

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

/// What stands beside a cell in the table, the printed value included where there is one.
Figures labels(const std::string& table, const std::string& shape, const std::string& row,
               const std::string& algorithm, const std::string& level) {
  return Figures()
      .set("table", table)
      .set("shape", shape)
      .set("row", row)
      .set("algorithm", algorithm)
      .set("level", level)
      .set("printed", printed_value(shape, row, algorithm == "auto" ? "ils-ucb" : algorithm));
}

/// The rows of the table: noise, bias.
struct TableRow {
  std::string name;
  double noise = 0.0, bias = 0.0;
};

std::vector<TableRow> table_rows() {
  std::vector<TableRow> rows;
  for (const int percent : {1, 5, 10, 25})
    rows.push_back({"noise " + std::to_string(percent) + " %", percent / 100.0, 0.0});
  for (const int percent : {1, 5, 50, 100})
    rows.push_back({"bias " + std::to_string(percent) + " %", 0.01, percent / 100.0});
  return rows;
}

/// The paper's model, with the level known and with that of its text.
void add_paper_cells(const Scene& base, const ExperimentArguments& arguments,
                     std::vector<Cell>& cells) {
  const bool keep_tumours = !arguments.scene.empty();
  const std::vector<std::string> shapes =
      keep_tumours ? std::vector<std::string>{"the scene's"} : kPaperShapes;
  for (const std::string level : {"known", "range"}) {
    for (const TableRow& row : table_rows()) {
      for (const std::string& shape : shapes) {
        for (const std::string& algorithm : kPaperAlgorithms) {
          const std::string name = row.name + ", " + shape + ", " + algorithm + ", level " + level;
          if (!is_chosen(name, arguments)) continue;
          Scene scene = base.with("probe.noise", row.noise)
                            .with("probe.bias", row.bias)
                            .with("plan.acquisition", algorithm)
                            .with("level.estimate", level);
          if (!keep_tumours) scene = scene.with("probe.tumours", paper_tumour(shape));
          cells.push_back({name, scene, labels("paper", shape, row.name, algorithm, level)});
        }
      }
    }
  }
}

/// The bound knows the shape's number of modes, and where its outline runs: a reference for every
/// method.
double bound_percent(const Scene& scene, const std::string& shape, double area_m2) {
  const int readings = scene.integer("plan.initial.count") +
                       scene.integer("plan.batch") * scene.integer("plan.batches");
  const ReferenceBound bound = reference_bound({.perimeter_m = paper_perimeter_m(shape),
                                                .slope_per_m = scene.number("probe.slope_per_m"),
                                                .noise = scene.number("probe.noise"),
                                                .readings = readings,
                                                .fraction = scene.number("level.fraction")});
  return 100.0 * bound.expected_error_m2 / area_m2;
}

/// The tool's defaults on the same phantoms, with the level unknown; a trend where there is a bias.
void add_default_cells(const Scene& base, const ExperimentArguments& arguments,
                       std::vector<Cell>& cells) {
  for (const TableRow& row : table_rows()) {
    for (const std::string& shape : kPaperShapes) {
      const std::string name = row.name + ", " + shape + ", the defaults";
      if (!is_chosen(name, arguments)) continue;
      const Scene scene = base.with("probe.noise", row.noise)
                              .with("probe.bias", row.bias)
                              .with("probe.tumours", paper_tumour(shape))
                              .with("field.trend", row.bias > 0.0 ? "linear" : "constant");
      cells.push_back(
          {name, scene, labels("defaults", shape, row.name, "auto", scene.word("level.estimate"))});
    }
  }
}

/// Adds what a run of the defaults is held against: half of the tumour's area, and the bound.
std::vector<Figures> with_references(std::vector<Figures> rows, const Cell& cell,
                                     const Surface& tissue) {
  if (cell.labels.word("table") != "defaults") return rows;
  const World world = simulated_world(cell.scene, tissue);
  const double half = 50.0 * superlevel_area(tissue, world.truth, world.true_level) / tissue.area();
  for (Figures& row : rows)
    row.set("lost", row.number("error_percent") > half)
        .set("bound_percent", bound_percent(cell.scene, cell.labels.word("shape"), tissue.area()));
  return rows;
}

void report_paper(const Results& results, const std::vector<std::size_t>& cells,
                  const ReportFolder& folder) {
  std::string csv = std::string("level,row,shape,algorithm,trials,error_percent,") +
                    kStatisticsColumns + ",printed\n";
  std::string level, line;
  for (const std::size_t i : cells) {
    const std::vector<Figures> trials = results.of(i);
    const Figures& cell = trials.front();
    const Statistics result = statistics(trials, "error_percent");
    if (cell.word("level") != level) {
      level = cell.word("level");
      std::printf(
          "\n\n%s\nSymmetric difference, %% of the search area: mean +- standard error of %d "
          "trials (printed in the paper)",
          level == "known" ? "Level known beforehand (the authors' code)"
                           : "Level from the greatest and least mean (the paper's text)",
          results.trials());
    }
    const std::string row = cell.word("row"), shape = cell.word("shape");
    if (line != level + row + shape) std::printf("\n%-12s%-12s", row.c_str(), shape.c_str());
    line = level + row + shape;
    std::printf("  %-8s%s (%s)", cell.word("algorithm").c_str(), in_words(result).c_str(),
                or_dash(cell.maybe_number("printed")).c_str());
    csv += level + "," + row + "," + shape + "," + cell.word("algorithm") + "," +
           std::to_string(trials.size()) + "," + csv_of(result) + "," + cell.word("printed") + "\n";
  }
  std::printf("\n");
  folder.write("table1", csv);
}

void report_defaults(const Results& results, const std::vector<std::size_t>& cells,
                     const ReportFolder& folder) {
  std::printf(
      "\nLevel unknown, the tool's defaults (trend on in the rows with bias); over half the tumour "
      "wrong: missed\n");
  std::printf(
      "%-12s%-12s  error, %%              (ILS-UCB as printed)  missed reference bound   error / "
      "bound\n",
      "", "");
  std::string csv = std::string("row,shape,trials,error_percent,") + kStatisticsColumns +
                    ",printed,lost,lost_low_95,lost_high_95,bound_percent\n";
  for (const std::size_t i : cells) {
    const std::vector<Figures> trials = results.of(i);
    const Figures& cell = trials.front();
    const Statistics result = statistics(trials, "error_percent");
    const int count = static_cast<int>(trials.size());
    const auto lost = static_cast<int>(
        std::ranges::count_if(trials, [](const Figures& trial) { return trial.flag("lost"); }));
    const Interval of_lost = wilson_interval(lost, count);
    const double bound = cell.number("bound_percent");
    std::printf("%-12s%-12s  %s (%s)  %12d  %16.3f  %14.2f\n", cell.word("row").c_str(),
                cell.word("shape").c_str(), in_words(result).c_str(),
                or_dash(cell.maybe_number("printed")).c_str(), lost, bound, result.mean / bound);
    csv += cell.word("row") + "," + cell.word("shape") + "," + std::to_string(count) + "," +
           csv_of(result) + "," + cell.word("printed") + "," + std::to_string(lost) + "," +
           text_of(of_lost.low) + "," + text_of(of_lost.high) + "," + text_of(bound) + "\n";
  }
  folder.write("table1_defaults", csv);
}

}  // namespace

Study table1_study(const ExperimentArguments& arguments) {
  std::vector<Cell> cells;
  if (arguments.scene.empty())
    add_default_cells(base_scene(arguments, default_scene()), arguments, cells);
  add_paper_cells(base_scene(arguments, paper_scene()), arguments, cells);
  Study study = error_study(cells);
  study.columns.insert(study.columns.end(), {"lost", "bound_percent"});
  if (cells.empty()) return study;
  const LazyTissue tissue(cells.front().scene);
  study.run = [run = study.run, cells, tissue](std::size_t cell, std::uint64_t seed) {
    return with_references(run(cell, seed), cells[cell], tissue.surface());
  };
  return study;
}

void report_table1(const Results& results, const ReportFolder& folder) {
  std::vector<std::size_t> defaults, paper;
  for (std::size_t i = 0; i < results.manifest.cells.size(); ++i)
    (results.of(i).front().word("table") == "paper" ? paper : defaults).push_back(i);
  if (!defaults.empty()) report_defaults(results, defaults, folder);
  if (!paper.empty()) report_paper(results, paper, folder);
}

}  // namespace palpation::tool
