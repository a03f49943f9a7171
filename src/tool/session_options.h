/// The options of `palpate session` and `palpate serve`.
#pragma once

#include <CLI/CLI.hpp>

namespace palpation::tool {

void add_session_command(CLI::App& app);
void add_serve_command(CLI::App& app);

}  // namespace palpation::tool
