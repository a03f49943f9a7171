// experiment NAME: which there are.
#include <algorithm>

#include "palpation/base/error.h"
#include "tool/commands.h"
#include "tool/experiment.h"
#include "tool/output_folder.h"

namespace palpation::tool {
namespace {

struct Experiment {
  const char* name;
  void (*run)(const ExperimentArguments& arguments);
  int trials = 5;
};

constexpr Experiment kExperiments[] = {
    {"table1", table1},     {"figure4", figure4},           {"table2", table2},
    {"coverage", coverage}, {"detection", detection},       {"recordings", recordings},
    {"curved", curved},     {"acquisitions", acquisitions}, {"tradeoff", tradeoff, 20},
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
  if (!arguments.out.empty() && !arguments.print_scene) make_folder(arguments.out);  // before hours of work, not after them
  ExperimentArguments complete = arguments;
  if (complete.trials == 0) complete.trials = found->trials;
  found->run(complete);
}

}  // namespace palpation::tool
