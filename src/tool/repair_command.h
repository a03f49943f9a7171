/// `palpate mesh repair`: what a mesh needs to be tissue, each repair only where it is asked for.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "palpation/io/read_mesh.h"

namespace palpation::tool {

struct RepairFiles {
  std::filesystem::path input, output;
  std::string unit;        ///< of both
  bool overwrite = false;  ///< another file of the output's name
};

/// Prints what was done, and how many elements each repair took. Writes a surface or nothing.
void repair_mesh(const RepairFiles& files, const MeshRepair& repair);

/// Adds the command to `palpate mesh`.
void add_repair_command(CLI::App& mesh);

}  // namespace palpation::tool
