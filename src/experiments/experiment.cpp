#include "experiments/experiment.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <sstream>

#include "experiments/lazy_tissue.h"
#include "palpation/base/error.h"
#include "scene/exit_code.h"
#include "scene/tissue.h"
#include "scene/words.h"
#include "scene/worlds.h"

namespace palpation::tool {

using nlohmann::json;

Scene base_scene(const ExperimentArguments& arguments, const json& standard) {
  if (!arguments.scene.empty()) return Scene::read(arguments.scene, arguments.overrides);
  return Scene(standard, "experiment " + arguments.name, ".").with_overrides(arguments.overrides);
}

bool is_chosen(const std::string& name, const ExperimentArguments& arguments) {
  return std::ranges::all_of(arguments.only, [&](const std::string& text) {
    return name.find(text) != std::string::npos;
  });
}

void refuse_no_cell(std::size_t cells, const ExperimentArguments& arguments) {
  if (cells > 0) return;
  std::string texts;
  for (const std::string& text : arguments.only)
    texts += (texts.empty() ? "'" : " and '") + text + "'";
  throw WrongUsage("experiment " + arguments.name + ": no cell has " + texts +
                   " in its name; --print-scene names them all");
}

bool printed_scenes(std::span<const Cell> cells, const ExperimentArguments& arguments) {
  if (!arguments.print_scene) return false;
  json all = json::array();
  for (const Cell& cell : cells) {
    if (!cell.alone) all.push_back({{"cell", cell.name}, {"scene", cell.scene.given()}});
  }
  if (all.size() == 1) all = json(all.front().at("scene"));  // a scene, which simulate takes
  std::printf("%s\n", all.dump(2, ' ', false, json::error_handler_t::replace).c_str());
  return true;
}

std::vector<std::string> label_columns(std::span<const Cell> cells) {
  std::vector<std::string> columns;
  for (const Cell& cell : cells) {
    for (const auto& [name, text] : cell.labels.texts()) {
      if (std::ranges::find(columns, name) == columns.end()) columns.push_back(name);
    }
  }
  return columns;
}

std::string list_text(std::span<const double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + text_of(value);
  return text;
}

std::vector<double> listed(const Figures& figures, const std::string& name) {
  std::istringstream text(figures.word(name));
  std::vector<double> values;
  for (std::string word; text >> word;) values.push_back(Figures().set(name, word).number(name));
  return values;
}

Study error_study(std::vector<Cell> cells) {
  Study study{.cells = std::move(cells)};
  study.columns = label_columns(study.cells);
  study.columns.insert(study.columns.end(), {"error_percent", "errors_percent"});
  if (study.cells.empty()) return study;
  const LazyTissue tissue(study.cells.front().scene);
  study.mesh_digest = [tissue](std::size_t) { return tissue.mesh_digest(); };
  study.run = [tissue, cells = study.cells](std::size_t cell, std::uint64_t seed) {
    const Surface& surface = tissue.surface();
    const Scene scene = cells[cell].scene.with("seed", seed);
    const Episode episode = run_episode(scene, surface, simulated_world(scene, surface));
    std::vector<double> errors;
    for (const TraceRow& row : episode.trace)
      errors.push_back(row.error ? 100.0 * row.error->symmetric_difference_m2 / surface.area()
                                 : 100.0);
    return std::vector{
        Figures().set("error_percent", errors.back()).set("errors_percent", list_text(errors))};
  };
  return study;
}

Statistics statistics(std::span<const double> values) {
  const double n = static_cast<double>(values.size());
  Statistics result;
  for (double value : values) result.mean += value / n;
  double square = 0.0;
  for (double value : values) square += (value - result.mean) * (value - result.mean);
  if (n > 1.0) result.standard_error = std::sqrt(square / (n - 1.0) / n);
  result.interval = mean_interval(values);
  return result;
}

Statistics statistics(std::span<const Figures> rows, const std::string& name) {
  return statistics(values_of(rows, name));
}

std::string csv_of(const Statistics& result) {
  const auto bound = [&](double Interval::*end) {
    return result.interval ? text_of((*result.interval).*end) : std::string();
  };
  return text_of(result.mean) + "," + or_empty(result.standard_error) + "," +
         bound(&Interval::low) + "," + bound(&Interval::high);
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

std::string in_words(const Statistics& result) {
  char words[64];
  std::snprintf(words, sizeof words, "%7.3f +- %-5s", result.mean,
                result.standard_error ? fixed(*result.standard_error, 3).c_str() : "-");
  return words;
}

std::string or_dash(const std::optional<double>& value) {
  return value ? fixed(*value, 3) : "  -  ";
}

std::string or_empty(const std::optional<double>& value) { return value ? text_of(*value) : ""; }

}  // namespace palpation::tool
