/// Words of a command line that nothing takes.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace palpation::tool {

/// Of a command line that could not be read: what it calls a command or an option and is none, each
/// with what is spelt most like it, a line each; empty where there is no such word.
std::string misspelt_words(const CLI::App& app);

}  // namespace palpation::tool
