/// What the values of options must be.
#pragma once

#include <CLI/CLI.hpp>

namespace palpation::tool {

inline constexpr double kMostSeed = 9007199254740991.0;  ///< as in a scene

/// A number in a range; what is no number is in none.
CLI::Validator number(double least, double most);
CLI::Validator whole(double least, double most);

}  // namespace palpation::tool
