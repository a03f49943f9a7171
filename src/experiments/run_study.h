/// Runs the trials of an experiment that are not there yet.
#pragma once

#include <optional>
#include <span>

#include "experiments/experiment_command.h"
#include "experiments/study.h"

namespace palpation::tool {

/// What the trials of a study are, for a program of this version.
Manifest manifest_of(const Study& study, const ExperimentArguments& arguments);

/// All rows: those in the folder for results, if there is one and it holds some, and those that are
/// missing, made now, several at once. Each trial's rows are on the disk before the next is begun.
/// Nothing where only a shard was asked for: its rows are in the folder then. Throws as RowFiles.
/// Where another experiment's results may be replaced, what is there is.
std::optional<Results> run_study(const Study& study, const ExperimentArguments& arguments,
                                 Existing results = Existing::Kept);

/// The rows of folders that hold the shards of one experiment. Throws IoError, by name, where one
/// is of another experiment, or doubled, or a trial is missing.
Results merged(std::span<const std::filesystem::path> folders);

}  // namespace palpation::tool
