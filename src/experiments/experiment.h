/// What the experiments share: cells of a table, trials in parallel, means with their standard
/// errors. Each experiment is one function in a file of its own, <name>.cpp, entered in
/// the table of experiment_command.cpp.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/experiment_command.h"
#include "scene/episode.h"
#include "scene/scene.h"

namespace palpation::tool {

void table1(const ExperimentArguments& arguments);
void recordings(const ExperimentArguments& arguments);
void figure4(const ExperimentArguments& arguments);
void table2(const ExperimentArguments& arguments);
void coverage(const ExperimentArguments& arguments);
void detection(const ExperimentArguments& arguments);
void curved(const ExperimentArguments& arguments);
void acquisitions(const ExperimentArguments& arguments);
void tradeoff(const ExperimentArguments& arguments);

/// The search area of Garg et al. 2016, section VII, with vertices half a millimetre apart and no
/// tumour yet; all else is as by default.
nlohmann::json random_tumours_scene();

/// The scene that was given, or this one, with the overrides.
Scene base_scene(const ExperimentArguments& arguments, const nlohmann::json& standard);

/// A scene that is run once per trial, each time with another seed.
struct Cell {
  std::string name;
  Scene scene;
};

/// Whether a cell of this name is to be run: it has all texts of --only in it.
bool is_chosen(const std::string& name, const ExperimentArguments& arguments);

/// Refuses a choice that leaves no cell.
void refuse_no_cell(std::size_t cells, const ExperimentArguments& arguments);

/// Where --print-scene was asked for, prints all scenes and returns true: nothing is to be run
/// then.
bool printed_scenes(std::span<const Cell> cells, const ExperimentArguments& arguments);

/// Runs `run(cell, trial, seed)` for every trial of every cell, several at once, and shows how far
/// it has come.
using Trial = std::function<void(std::size_t cell, std::size_t trial, std::uint64_t seed)>;
void for_trials(std::size_t cells, const ExperimentArguments& arguments, const Trial& run);

/// The error after every batch of every trial, in % of the search area: [cell][trial][batch].
using Errors = std::vector<std::vector<std::vector<double>>>;
/// All cells against the scene's own simulated phantom, on the tissue that is common to them.
Errors run_trials(std::span<const Cell> cells, const ExperimentArguments& arguments);
/// The errors after the last batch, one per trial.
std::vector<double> finals(const std::vector<std::vector<double>>& trials);

struct Statistics {
  double mean = 0.0;
  std::optional<double> standard_error{};  ///< nothing for a single trial
};
Statistics statistics(std::span<const double> values);

/// NaN of none.
double median(std::vector<double> values);

/// "  0.063 +- 0.002", or "-" in place of an error that is not known.
std::string in_words(const Statistics& result);
/// "0.063", or "  -  " where there is no value.
std::string or_dash(const std::optional<double>& value);
/// As text_of, or empty where there is no value: for CSV.
std::string or_empty(const std::optional<double>& value);

/// Writes a table to the folder for results, if there is one.
void write_table(const ExperimentArguments& arguments, const std::string& name,
                 const std::string& csv);

}  // namespace palpation::tool
