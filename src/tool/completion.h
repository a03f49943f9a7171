/// Completion for bash, made of the commands, their options and the keys of a scene.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace palpation::tool {

/// A script that bash sources: commands, options, keys behind --set and help, and files.
std::string completion(const CLI::App& app);

}  // namespace palpation::tool
