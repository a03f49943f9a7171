/// The manual page, made of what the commands and the keys of a scene say of themselves.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace palpation::tool {

/// palpate(1), as man takes it.
std::string man_page(const CLI::App& app);

}  // namespace palpation::tool
