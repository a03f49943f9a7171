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

struct Entry {
  const Method* method;
  std::string shape;
  int noise_percent;
  bool lag_modelled;
  std::optional<double> printed;
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

struct Table {
  std::vector<Entry> entries;
  std::vector<Cell> cells;  ///< one per entry
};

Table table_of(const Scene& base, const ExperimentArguments& arguments) {
  const bool keep_tumours = !arguments.scene.empty();
  Table table;
  for (const Method& method : methods()) {
    for (const bool lag_modelled : {false, true}) {
      for (const std::string& shape :
           keep_tumours ? std::vector<std::string>{"the scene's"} : kPaperShapes) {
        for (const int percent : {5, 10}) {
          Scene scene = base.with("probe.noise", percent / 100.0)
                            .with("field.lag_mm", lag_modelled ? json("learn") : json(0.0));
          for (const auto& [path, value] : method.changes.items()) scene = scene.with(path, value);
          if (!keep_tumours) scene = scene.with("probe.tumours", tumour_of(shape));
          const std::string lag = lag_modelled ? "lag learned" : "lag ignored";
          const std::string name =
              method.name + ", " + lag + ", " + shape + ", noise " + std::to_string(percent) + " %";
          if (!is_chosen(name, arguments)) continue;
          table.entries.push_back(
              {&method, shape, percent, lag_modelled,
               keep_tumours ? std::nullopt : printed_value(method.column, shape)});
          table.cells.push_back({name, scene});
        }
      }
    }
  }
  return table;
}

void report(const std::vector<Entry>& entries, const Errors& errors,
            const ExperimentArguments& arguments) {
  std::string csv = "method,lag,shape,noise_percent,trials,error_percent,standard_error,printed\n";
  std::printf(
      "\nSymmetric difference, %% of the search area: mean +- standard error of %d trials (printed "
      "in the paper, noise unknown)\n",
      arguments.trials);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& entry = entries[i];
    const Statistics result = statistics(finals(errors[i]));
    const std::string lag = entry.lag_modelled ? "learned" : "ignored";
    if (i == 0 || entries[i - 1].method != entry.method ||
        entries[i - 1].lag_modelled != entry.lag_modelled)
      std::printf("\n%s, lag %s\n", entry.method->words.c_str(), lag.c_str());
    std::printf("  %-12s noise %2d %% %s (%s)\n", entry.shape.c_str(), entry.noise_percent,
                in_words(result).c_str(), or_dash(entry.printed).c_str());
    csv += entry.method->name + "," + lag + "," + entry.shape + "," +
           std::to_string(entry.noise_percent) + "," + std::to_string(arguments.trials) + "," +
           text_of(result.mean) + "," + or_empty(result.standard_error) + "," +
           or_empty(entry.printed) + "\n";
  }
  write_table(arguments, "table2", csv);
}

}  // namespace

void table2(const ExperimentArguments& arguments) {
  const Table table = table_of(base_scene(arguments, physical_scene()), arguments);
  refuse_no_cell(table.cells.size(), arguments);
  if (printed_scenes(table.cells, arguments)) return;
  report(table.entries, run_trials(table.cells, arguments), arguments);
}

}  // namespace palpation::tool
