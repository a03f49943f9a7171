/// The command that runs an experiment by its name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/single_file.h"

namespace palpation::tool {

/// What an experiment is made on besides a scene.
struct Material {
  std::filesystem::path recordings{};  ///< the folder that holds them
  std::string world{};                 ///< of coverage: a family or a kind of worlds, or all
};

struct ExperimentArguments {
  std::string name;
  std::filesystem::path scene;  ///< empty: the paper's
  std::vector<std::string> overrides;
  std::vector<std::string> only;  ///< run the cells whose names have all of these in them
  int trials = 0;                 ///< 0: as many as the experiment takes by default
  std::uint64_t first_seed = 0;
  bool print_scene = false;
  Material material;
  std::string shard;  ///< "3/8"; empty: all
  std::filesystem::path out;
  bool quiet = false;
};

void experiment(const ExperimentArguments& arguments, Existing results);
/// Adds up the folders that hold the shards of one experiment, and reports it.
void merge_experiment(const std::vector<std::filesystem::path>& folders,
                      const std::filesystem::path& out, Existing results);
/// Prints the experiments that there are, or of one the names of its cells.
void list_experiments(const ExperimentArguments& arguments);
/// The experiments that there are, and merge.
std::vector<std::string> experiment_names();

}  // namespace palpation::tool
