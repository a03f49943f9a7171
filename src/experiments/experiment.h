/// What the experiments share: cells of a table, means with their standard errors. Each experiment
/// is a study and its report in a file of its own, entered in the table of experiment_command.cpp.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/experiment_command.h"
#include "experiments/intervals.h"
#include "experiments/study.h"
#include "scene/episode.h"
#include "scene/scene.h"

namespace palpation::tool {

Study table1_study(const ExperimentArguments& arguments);
Study figure4_study(const ExperimentArguments& arguments);
Study table2_study(const ExperimentArguments& arguments);
Study coverage_study(const ExperimentArguments& arguments);
Study detection_study(const ExperimentArguments& arguments);
Study recordings_study(const ExperimentArguments& arguments);
Study curved_study(const ExperimentArguments& arguments);
Study acquisitions_study(const ExperimentArguments& arguments);
Study tradeoff_study(const ExperimentArguments& arguments);
Study users_study(const ExperimentArguments& arguments);

void report_table1(const Results& results, const ReportFolder& folder);
void report_figure4(const Results& results, const ReportFolder& folder);
void report_table2(const Results& results, const ReportFolder& folder);
void report_coverage(const Results& results, const ReportFolder& folder);
void report_detection(const Results& results, const ReportFolder& folder);
void report_recordings(const Results& results, const ReportFolder& folder);
void report_curved(const Results& results, const ReportFolder& folder);
void report_acquisitions(const Results& results, const ReportFolder& folder);
/// Its cells: every choice by every seed, and the memory of each.
inline constexpr std::size_t kTradeoffTrials = 0, kTradeoffMemory = 1;
void report_tradeoff(const Results& results, const ReportFolder& folder);
void report_users_study(const Results& results, const ReportFolder& folder);

/// The search area of Garg et al. 2016, section VII, with vertices half a millimetre apart and no
/// tumour yet; all else is as by default.
nlohmann::json random_tumours_scene();

/// The scene that was given, or this one, with the overrides.
Scene base_scene(const ExperimentArguments& arguments, const nlohmann::json& standard);

/// Whether a cell of this name is to be run: it has all texts of --only in it.
bool is_chosen(const std::string& name, const ExperimentArguments& arguments);

/// Refuses a choice that leaves no cell.
void refuse_no_cell(std::size_t cells, const ExperimentArguments& arguments);

/// Where --print-scene was asked for, prints all scenes and returns true: nothing is to be run
/// then.
bool printed_scenes(std::span<const Cell> cells, const ExperimentArguments& arguments);

/// A study of cells against the scene's own simulated phantom, on the tissue that is common to
/// them. Its figures: error_percent of the search area after the last batch, errors_percent after
/// every one, with blanks between them.
Study error_study(std::vector<Cell> cells);
/// The columns of all labels of all cells, in the order of their first appearance.
std::vector<std::string> label_columns(std::span<const Cell> cells);
/// Numbers of a figure that holds several.
std::vector<double> listed(const Figures& figures, const std::string& name);
std::string list_text(std::span<const double> values);

struct Statistics {
  double mean = 0.0;
  std::optional<double> standard_error{};  ///< nothing for a single trial
  std::optional<Interval> interval{};      ///< of the mean, 95 %; nothing for a single trial
};
Statistics statistics(std::span<const double> values);
/// Of a figure of some rows.
Statistics statistics(std::span<const Figures> rows, const std::string& name);

/// NaN of none.
double median(std::vector<double> values);

/// "  0.063 +- 0.002", or "-" in place of an error that is not known.
std::string in_words(const Statistics& result);
/// "0.063", or "  -  " where there is no value.
std::string or_dash(const std::optional<double>& value);
/// As text_of, or empty where there is no value: for CSV.
std::string or_empty(const std::optional<double>& value);

/// "mean,standard error,low,high" for CSV; the last three empty for a single trial.
std::string csv_of(const Statistics& result);
inline constexpr const char* kStatisticsColumns = "standard_error,low_95,high_95";

}  // namespace palpation::tool
