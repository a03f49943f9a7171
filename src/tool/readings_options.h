/// The options of `palpate readings`.
#pragma once

#include <CLI/CLI.hpp>

namespace palpation::tool {

void add_readings_command(CLI::App& app);

}  // namespace palpation::tool
