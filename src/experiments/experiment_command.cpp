#include "experiments/experiment_command.h"

#include <algorithm>

#include "experiments/experiment.h"
#include "palpation/base/error.h"
#include "scene/exit_code.h"
#include "scene/output_folder.h"

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

}  // namespace

std::vector<std::string> experiment_names() {
  std::vector<std::string> names;
  for (const Experiment& experiment : kExperiments) names.emplace_back(experiment.name);
  return names;
}

void experiment(const ExperimentArguments& arguments) {
  const auto* found = std::ranges::find(kExperiments, arguments.name, &Experiment::name);
  require(found != std::end(kExperiments), "experiment", arguments.name, "is none");
  if (!arguments.only.empty() && !found->cells_stand_alone)
    throw WrongUsage(
        "experiment " + arguments.name +
        ": --only chooses among the cells of table1, table2 and curved, not of this one");
  if (!arguments.out.empty() && !arguments.print_scene)
    make_folder(arguments.out);  // before hours of work, not after them
  ExperimentArguments complete = arguments;
  if (complete.trials == 0) complete.trials = found->trials;
  found->run(complete);
}

}  // namespace palpation::tool
