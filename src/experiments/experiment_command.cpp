#include "experiments/experiment_command.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "experiments/experiment.h"
#include "experiments/row_files.h"
#include "experiments/run_study.h"
#include "io/folder_lock.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "scene/exit_code.h"
#include "scene/make_folder.h"
#include "scene/single_file.h"

namespace palpation::tool {
namespace {

namespace fs = std::filesystem;

struct Experiment {
  const char* name;
  const char* what;
  Study (*study)(const ExperimentArguments& arguments);
  void (*report)(const Results& results, const ReportFolder& folder);
  int trials = 5;
  bool cells_stand_alone = false;  ///< so that --only may choose among them
};

constexpr Experiment kExperiments[] = {
    {"table1", "the paper's Table I, rerun", table1_study, report_table1, 5, true},
    {"figure4", "its convergence, drawn", figure4_study, report_figure4},
    {"table2", "the physical experiments in simulation: late readings, and those on the way",
     table2_study, report_table2, 5, true},
    {"coverage", "how often the band holds tumours of random shape", coverage_study,
     report_coverage},
    {"detection", "false alarms on healthy tissue, and missed tumours", detection_study,
     report_detection},
    {"recordings", "the real robot's recordings, where you have them", recordings_study,
     report_recordings},
    {"curved", "curved tissue by each metric of the field: what it is worth, what it costs",
     curved_study, report_curved, 5, true},
    {"acquisitions", "which criterion is best where the level is unknown", acquisitions_study,
     report_acquisitions},
    {"tradeoff", "what each way to be faster costs on your scene", tradeoff_study, report_tradeoff,
     20},
    {"study", "a scene with lists of values and a folder of meshes: cells of your own", users_study,
     report_users_study, 5, true},
};

/// Tables and pictures begin with the experiment's name.
void refuse_to_replace_results(const fs::path& folder, const std::string& name, Existing results) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (entry.path().filename().string().starts_with(name) &&
        (extension == ".csv" || extension == ".png"))
      refuse_to_replace(entry.path(), results);
  }
}

const Experiment& experiment_called(const std::string& name) {
  const auto* found = std::ranges::find(kExperiments, name, &Experiment::name);
  require(found != std::end(kExperiments), "experiment", name, "is none");
  return *found;
}

void check(const ExperimentArguments& arguments, const Experiment& experiment) {
  if (!arguments.only.empty() && !experiment.cells_stand_alone)
    throw WrongUsage("experiment " + arguments.name +
                     ": --only chooses among the cells of table1, table2, curved and study, not of "
                     "this one");
  if (!arguments.material.world.empty() && arguments.name != "coverage")
    throw WrongUsage("experiment " + arguments.name + ": --world is for experiment coverage");
  if (!arguments.shard.empty() && arguments.out.empty())
    throw WrongUsage("experiment " + arguments.name +
                     ": --shard needs --out: the folder that its rows are kept in");
}

/// Locks the folder for results, and leaves what a person put there alone: before hours of work,
/// not after them. Tables beside our own manifest are ours.
std::unique_ptr<FolderLock> prepared(const fs::path& folder, const std::string& name,
                                     Existing results) {
  if (folder.empty()) return nullptr;
  make_folder(folder);
  auto lock = std::make_unique<FolderLock>(folder, "experiment " + name);
  if (!fs::exists(folder / kManifestFile)) refuse_to_replace_results(folder, name, results);
  return lock;
}

}  // namespace

std::vector<std::string> experiment_names() {
  std::vector<std::string> names;
  for (const Experiment& experiment : kExperiments) names.emplace_back(experiment.name);
  names.emplace_back("merge");
  return names;
}

void list_experiments(const ExperimentArguments& arguments) {
  if (!arguments.name.empty()) {
    if (arguments.name == "merge")
      throw WrongUsage(
          "experiment merge: has no cells: --list those of the experiment whose shards they are");
    const Experiment& experiment = experiment_called(arguments.name);
    check(arguments, experiment);
    const Study study = experiment.study(arguments);
    refuse_no_cell(study.cells.size(), arguments);
    for (const Cell& cell : study.printed.empty() ? study.cells : study.printed)
      std::printf("%s\n", cell.name.c_str());
    return;
  }
  for (const Experiment& experiment : kExperiments)
    std::printf("%-13s %s\n", experiment.name, experiment.what);
  std::printf("%-13s %s\n", "merge", "shards of any of them, added up");
}

void experiment(const ExperimentArguments& arguments, Existing existing) {
  const Experiment& experiment = experiment_called(arguments.name);
  check(arguments, experiment);
  const Study study = experiment.study(arguments);
  refuse_no_cell(study.cells.size(), arguments);
  if (printed_scenes(study.printed.empty() ? study.cells : study.printed, arguments)) return;
  ExperimentArguments complete = arguments;
  if (complete.trials == 0) complete.trials = study.trials > 0 ? study.trials : experiment.trials;
  const auto lock = prepared(arguments.out, arguments.name, existing);
  const std::optional<Results> results = run_study(study, complete, existing);
  if (results) return experiment.report(*results, {arguments.out});
  std::printf(
      "Shard %s is done: its rows are in %s. When all are, add them up:\n"
      "  palpate experiment merge FOLDER... --out FOLDER\n",
      arguments.shard.c_str(), arguments.out.string().c_str());
}

void merge_experiment(const std::vector<fs::path>& folders, const fs::path& out,
                      Existing existing) {
  const Results results = merged(folders);
  const Experiment& experiment = experiment_called(results.manifest.experiment);
  const auto lock = prepared(out, results.manifest.experiment, existing);
  if (!out.empty()) RowFiles(out, results.manifest, Shard{}, existing).replace(results.rows);
  experiment.report(results, {out});
}

}  // namespace palpation::tool
