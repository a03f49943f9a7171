#include "experiments/experiment.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <mutex>

#include "palpation/base/error.h"
#include "palpation/base/parallel.h"
#include "scene/exit_code.h"
#include "scene/progress.h"
#include "scene/single_file.h"
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
  for (const Cell& cell : cells)
    all.push_back({{"cell", cell.name}, {"scene", cell.scene.given()}});
  std::printf("%s\n", all.dump(2, ' ', false, json::error_handler_t::replace).c_str());
  return true;
}

void for_trials(std::size_t cells, const ExperimentArguments& arguments, const Trial& run) {
  const int runs = static_cast<int>(cells) * arguments.trials;
  Progress progress("Runs", runs, arguments.quiet);
  std::mutex progress_guard;
  int done = 0;
  for_ranges(runs, 1, [&](int first, int last) {
    for (int number = first; number < last; ++number) {
      const int trial = number % arguments.trials;
      run(static_cast<std::size_t>(number / arguments.trials), static_cast<std::size_t>(trial),
          arguments.first_seed + static_cast<std::uint64_t>(trial));
      const std::lock_guard lock(progress_guard);
      if (++done % std::max(1, runs / 100) == 0 || done == runs) progress.step(done, "");
    }
  });
}

Errors run_trials(std::span<const Cell> cells, const ExperimentArguments& arguments) {
  const Tissue tissue = tissue_of(cells.front().scene);
  const Surface& surface = tissue.surface;
  Errors errors(cells.size(),
                std::vector<std::vector<double>>(static_cast<std::size_t>(arguments.trials)));
  for_trials(cells.size(), arguments, [&](std::size_t cell, std::size_t trial, std::uint64_t seed) {
    const Scene scene = cells[cell].scene.with("seed", seed);
    const Episode episode = run_episode(scene, surface, simulated_world(scene, surface));
    for (const TraceRow& row : episode.trace) {
      errors[cell][trial].push_back(
          row.error ? 100.0 * row.error->symmetric_difference_m2 / surface.area() : 100.0);
    }
  });
  return errors;
}

std::vector<double> finals(const std::vector<std::vector<double>>& trials) {
  std::vector<double> values;
  for (const auto& trial : trials) values.push_back(trial.back());
  return values;
}

Statistics statistics(std::span<const double> values) {
  const double n = static_cast<double>(values.size());
  Statistics result;
  for (double value : values) result.mean += value / n;
  double square = 0.0;
  for (double value : values) square += (value - result.mean) * (value - result.mean);
  if (n > 1.0) result.standard_error = std::sqrt(square / (n - 1.0) / n);
  return result;
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

void write_table(const ExperimentArguments& arguments, const std::string& name,
                 const std::string& csv) {
  if (arguments.out.empty()) return;
  write_single_file(arguments.out / (name + ".csv"), csv, Existing::Replaced);
}

}  // namespace palpation::tool
