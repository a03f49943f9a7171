/// Whether a sensor's range seems to have ended.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace palpation {

/// Readings that stopped at one value.
struct Saturation {
  double value = 0.0;
  std::size_t count = 0;
  bool is_upper = true;  ///< the greatest of all; false: the least
  bool is_alone = true;  ///< readings at the other end are not alike as well, as without noise
};

/// The greatest value, or else the least, where three readings or more are exactly that, more than
/// twice as many as share any value between, yet fewer than half: beyond the end of its range a
/// sensor says the same of all, which noise does not. Nothing for readings that are all equal.
std::optional<Saturation> saturation_of(std::span<const double> readings);

}  // namespace palpation
