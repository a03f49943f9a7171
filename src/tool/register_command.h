/// register: where the tissue is, from places that the robot touched.
#pragma once

#include <CLI/CLI.hpp>

namespace palpation::tool {

void add_register_command(CLI::App& app);

}  // namespace palpation::tool
