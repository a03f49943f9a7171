/// What the values of options must be.
#pragma once

#include <CLI/CLI.hpp>

namespace palpation::tool {

/// A number in a range; what is no number is in none.
CLI::Validator number(double least, double most);
CLI::Validator whole(double least, double most);

}  // namespace palpation::tool
