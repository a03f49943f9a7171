/// Where the marks of an axis go, and what is written beside them.
#pragma once

#include <string>
#include <vector>

namespace palpation::draw {

struct Tick {
  double value = 0.0;
  std::string label;  ///< empty for a small mark without text
};

/// About `wanted` round numbers (1, 2 or 5 times a power of ten) within [lowest, highest].
std::vector<Tick> ticks(double lowest, double highest, int wanted);

/// Powers of ten with labels, 2 to 9 between them without (2 and 5 with labels if the axis spans
/// less than two decades).
std::vector<Tick> logarithmic_ticks(double lowest, double highest);

/// A number for people: this many significant digits, no trailing zeros, a true minus sign.
std::string short_number(double value, int significant_digits);

}  // namespace palpation::draw
