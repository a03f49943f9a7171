/// The options of `palpate session`.
#pragma once

#include <CLI/CLI.hpp>

namespace palpation::tool {

void add_session_command(CLI::App& app);

}  // namespace palpation::tool
