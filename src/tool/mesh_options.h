/// The command line of `palpate mesh`.
#pragma once

#include <CLI/CLI.hpp>

#include "tool/commands.h"
#include "tool/surface_command.h"

namespace palpation::tool {

/// Adds the command. It runs on these arguments: they must outlive the parsing.
void add_mesh_command(CLI::App& app, MeshArguments& mesh, SurfaceArguments& surface);

}  // namespace palpation::tool
