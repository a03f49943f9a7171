/// The command line of `palpate mesh`.
#pragma once

#include <CLI/CLI.hpp>

namespace palpation::tool {

void add_mesh_command(CLI::App& app);

}  // namespace palpation::tool
