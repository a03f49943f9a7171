/// palpate-draw, the program that draws: in a process of its own, since the graphics stack of a
/// machine may fail or hang, and a run is worth more than its picture.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palpation::tool {

/// Runs palpate-draw, which lies beside this program, with the given arguments. Returns why there
/// is no picture, or nothing.
std::optional<std::string> run_draw(const std::vector<std::string>& arguments);

/// The same for any program. It is ended when this one ends, in whatever way; after `patience_s`;
/// and when this one is interrupted.
std::optional<std::string> run_helper(const std::filesystem::path& program,
                                      const std::vector<std::string>& arguments, double patience_s);

}  // namespace palpation::tool
