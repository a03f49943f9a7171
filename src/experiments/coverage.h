/// How a run of a known world came out against what it said of itself: what experiment coverage
/// counts.
#pragma once

#include "experiments/experiment_command.h"
#include "experiments/study.h"
#include "scene/episode.h"

namespace palpation::tool {

/// Figures of a run whose world is known: found, lost, covered, needed_width, half_width_mm,
/// expected_error_mm2, error_mm2, warnings.
Figures against_truth(const Episode& episode, const World& world);
/// Its columns.
std::vector<std::string> columns_against_truth();

/// Where a scene says that it is off, there is none to hold against the truth.
void refuse_without_certainty(const Scene& scene);

/// coverage --world NAME|all.
Study worlds_study(const ExperimentArguments& arguments);
void report_worlds(const Results& results, const ReportFolder& folder);

}  // namespace palpation::tool
