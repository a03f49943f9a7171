/// Whether a sensor's range seems to have ended.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "palpation/readings/palpation.h"

namespace palpation {

/// Readings that stopped at one value.
struct Saturation {
  double value = 0.0;
  std::size_t count = 0;
  bool is_upper = true;  ///< the greatest of all; false: the least
  /// They are most of all, or those at the other end are alike, too: as well tissue that reads the
  /// same without noise.
  bool may_be_tissue = false;
  std::optional<int> session{};  ///< whose readings these are; none: of all

  /// Whether nothing but the range explains that a reading is that value.
  bool ends(const Palpation& palpation) const {
    return !may_be_tissue && palpation.reading == value &&
           (!session || palpation.session == *session);
  }
};

/// The greatest value, or else the least, where three readings or more are exactly that, and more
/// than twice as many as share any value between: beyond the end of its range a sensor says the
/// same of all, which noise does not. It lies at most twice as far from the others as those span:
/// what is farther is a fault. Nothing for readings of fewer than three values.
std::optional<Saturation> saturation_of(std::span<const double> readings);

/// That of all readings that are used, and those of sessions that end elsewhere, rising: each may
/// have a sensor, a zero and a gain of its own.
std::vector<Saturation> saturations_of(std::span<const Palpation> palpations);

}  // namespace palpation
