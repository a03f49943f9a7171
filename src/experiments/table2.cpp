// experiment table2: the physical experiments of Garg et al. 2016 (section VII) in simulation. The
// probe slides, and its readings come late.
#include <cstdio>
#include <map>

#include "experiments/experiment.h"
#include "experiments/paper_scene.h"
#include "palpation/base/error.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

/// A way to scan, and what is changed for it in the scene.
struct Method {
  std::string name;    ///< in the CSV
  std::string words;   ///< in the table
  std::string column;  ///< of the paper's table; empty where it has none
  json changes;        ///< paths to values
};

/// The search area, the level and the number of stops of the physical experiments; readings 1.5 mm
/// late. As by default, but for that.
json physical_scene() {
  return {
      {"version", 1},
      {"surface", {{"plane", {{"size_mm", {54, 49}}, {"vertices", {109, 99}}}}}},
      {"field", json::object()},
      {"level", {{"fraction", 0.7}}},
      {"plan", {{"initial", {{"design", "grid"}, {"count", 16}}}, {"batch", 10}, {"batches", 20}}},
      {"probe",
       {{"kind", "simulated"},
        {"low", 7},
        {"high", 9},
        {"slope_per_m", 1400},
        {"noise", 0.05},
        {"lag_mm", 1.5},
        {"tumours", json::array()}}},
      {"seed", 0}};
}

/// Areas of 1.84 and 3.84 cm2, as the silicone phantoms' tumours.
json tumour_of(const std::string& shape) {
  return shape == "disk" ? disk_mm(27, 24.5, 7.653) : horseshoe_mm(22.78, 24.5, 12.05, 4.30);
}

/// The model of the paper (see paper_scene) and its level, as changes.
json papers_model() {
  const json field = paper_scene()["field"];
  json changes = {{"level.estimate", "range"},
                  {"plan.scaling", "max"},
                  {"plan.gamma", 0.5},
                  {"plan.least_spacing_mm", 0},
                  {"plan.safe_start", false}};
  for (const auto& [key, value] : field.items()) changes["field." + key] = value;
  return changes;
}

json with(json changes, const json& more) {
  changes.update(more);
  return changes;
}

const std::vector<Method>& methods() {
  static const std::vector<Method> all = {
      {"raster", "raster, paper's model", "raster",
       with(papers_model(), {{"plan.acquisition", "raster"}})},
      {"ils-ucb", "ILS-UCB, paper's model", "ils-ucb",
       with(papers_model(), {{"plan.acquisition", "ils-ucb"}})},
      {"stops", "ours, stops only", "", json::object()},
      {"way", "ours, with readings along the way", "", {{"plan.readings_along_path", true}}},
  };
  return all;
}

/// Table II as printed, in % of the search area, at the noise that the silicone phantoms had.
std::optional<double> printed_value(const std::string& column, const std::string& shape) {
  static const std::map<std::string, std::pair<double, double>> values = {
      {"raster", {3.60, 3.73}}, {"ils-ucb", {1.87, 6.76}}};
  const auto found = values.find(column);
  if (found == values.end()) return std::nullopt;
  return shape == "disk" ? found->second.first : found->second.second;
}

std::vector<Cell> cells_of(const Scene& base, const ExperimentArguments& arguments) {
  const bool keep_tumours = !arguments.scene.empty();
  std::vector<Cell> cells;
  for (const Method& method : methods()) {
    for (const bool lag_modelled : {false, true}) {
      for (const std::string& shape :
           keep_tumours ? std::vector<std::string>{"the scene's"} : kPaperShapes) {
        for (const int percent : {5, 10}) {
          Scene scene = base.with("probe.noise", percent / 100.0)
                            .with("field.lag_mm", lag_modelled ? json("learn") : json(0.0));
          for (const auto& [path, value] : method.changes.items()) scene = scene.with(path, value);
          if (!keep_tumours) scene = scene.with("probe.tumours", tumour_of(shape));
          const std::string lag = lag_modelled ? "learned" : "ignored";
          const std::string name = method.name + ", lag " + lag + ", " + shape + ", noise " +
                                   std::to_string(percent) + " %";
          if (!is_chosen(name, arguments)) continue;
          cells.push_back(
              {name, scene,
               Figures()
                   .set("method", method.name)
                   .set("words", method.words)
                   .set("lag", lag)
                   .set("shape", shape)
                   .set("noise_percent", std::to_string(percent))
                   .set("printed",
                        keep_tumours ? std::nullopt : printed_value(method.column, shape))});
        }
      }
    }
  }
  return cells;
}

}  // namespace

Study table2_study(const ExperimentArguments& arguments) {
  return error_study(cells_of(base_scene(arguments, physical_scene()), arguments));
}

void report_table2(const Results& results, const ReportFolder& folder) {
  std::string csv = std::string("method,lag,shape,noise_percent,trials,error_percent,") +
                    kStatisticsColumns + ",printed\n";
  std::printf(
      "\nSymmetric difference, %% of the search area: mean +- standard error of %d trials (printed "
      "in the paper, noise unknown)\n",
      results.trials());
  std::string heading;
  for (std::size_t i = 0; i < results.manifest.cells.size(); ++i) {
    const std::vector<Figures> trials = results.of(i);
    const Figures& cell = trials.front();
    const Statistics result = statistics(trials, "error_percent");
    const std::string words = cell.word("words") + ", lag " + cell.word("lag");
    if (words != heading) std::printf("\n%s\n", words.c_str());
    heading = words;
    std::printf("  %-12s noise %2s %% %s (%s)\n", cell.word("shape").c_str(),
                cell.word("noise_percent").c_str(), in_words(result).c_str(),
                or_dash(cell.maybe_number("printed")).c_str());
    csv += cell.word("method") + "," + cell.word("lag") + "," + cell.word("shape") + "," +
           cell.word("noise_percent") + "," + std::to_string(trials.size()) + "," + csv_of(result) +
           "," + cell.word("printed") + "\n";
  }
  folder.write("table2", csv);
}

}  // namespace palpation::tool
