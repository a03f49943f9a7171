/// palpate help: every command, every key of a scene, and both as a manual page and for bash.
#pragma once

#include <CLI/CLI.hpp>

namespace palpation::tool {

/// To be added when all other commands are: they are what it explains.
void add_help_command(CLI::App& app);

}  // namespace palpation::tool
