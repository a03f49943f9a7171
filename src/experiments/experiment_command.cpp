#include "experiments/experiment_command.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "experiments/experiment.h"
#include "palpation/base/error.h"
#include "scene/exit_code.h"
#include "scene/folder_lock.h"
#include "scene/make_folder.h"
#include "scene/single_file.h"

namespace palpation::tool {
namespace {

struct Experiment {
  const char* name;
  void (*run)(const ExperimentArguments& arguments);
  int trials = 5;
  bool cells_stand_alone = false;  ///< so that --only may choose among them
};

constexpr Experiment kExperiments[] = {
    {"table1", table1, 5, true}, {"figure4", figure4},           {"table2", table2, 5, true},
    {"coverage", coverage},      {"detection", detection},       {"recordings", recordings},
    {"curved", curved, 5, true}, {"acquisitions", acquisitions}, {"tradeoff", tradeoff, 20},
};

/// Tables and pictures begin with the experiment's name.
void refuse_to_replace_results(const ExperimentArguments& arguments, Existing tables) {
  for (const auto& entry : std::filesystem::directory_iterator(arguments.out)) {
    const std::string extension = entry.path().extension().string();
    if (entry.path().filename().string().starts_with(arguments.name) &&
        (extension == ".csv" || extension == ".png"))
      refuse_to_replace(entry.path(), tables);
  }
}

}  // namespace

std::vector<std::string> experiment_names() {
  std::vector<std::string> names;
  for (const Experiment& experiment : kExperiments) names.emplace_back(experiment.name);
  return names;
}

void experiment(const ExperimentArguments& arguments, Existing tables) {
  const auto* found = std::ranges::find(kExperiments, arguments.name, &Experiment::name);
  require(found != std::end(kExperiments), "experiment", arguments.name, "is none");
  if (!arguments.only.empty() && !found->cells_stand_alone)
    throw WrongUsage(
        "experiment " + arguments.name +
        ": --only chooses among the cells of table1, table2 and curved, not of this one");
  std::optional<FolderLock> lock;
  if (!arguments.out.empty() && !arguments.print_scene) {  // before hours of work, not after them
    make_folder(arguments.out);
    lock.emplace(arguments.out, "experiment " + arguments.name);
    refuse_to_replace_results(arguments, tables);
  }
  ExperimentArguments complete = arguments;
  if (complete.trials == 0) complete.trials = found->trials;
  found->run(complete);
}

}  // namespace palpation::tool
