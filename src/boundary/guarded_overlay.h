/// The one way to an overlay: counted first, its failures put into words. Private to this folder.
#pragma once

#include <CGAL/exceptions.h>

#include <cmath>
#include <limits>
#include <string>

#include "boundary/crossings.h"
#include "boundary/overlay.h"
#include "boundary/quiet_cgal.h"
#include "palpation/base/error.h"

namespace palpation {

/// An overlay takes about 2 kB a crossing.
inline constexpr long kMostCrossings = 500'000;

/// Builds the overlay of two layers of rings and makes something of it. Throws InvalidInput where
/// the rings cross too often; whatever CGAL throws, and what contradicts itself, comes out as
/// NumericalError with what `reproduce` says to try again with.
template <typename Reproduce, typename Make>
auto with_overlay(const std::string& function, const RingPointers& first,
                  const RingPointers& second, Reproduce reproduce, Make make) {
  RingPointers all = first;
  all.insert(all.end(), second.begin(), second.end());
  require(
      cross_at_most(kMostCrossings, all), function, "the rings' edges",
      "may cross, overlap or meet in a crowd at most " + std::to_string(kMostCrossings) + " times");
  const QuietCgal quiet;
  try {
    return make(Overlay(first, second));
  } catch (const CGAL::Failure_exception& error) {
    throw NumericalError(function + ": " + error.what() + " for " + reproduce());
  } catch (const NumericalError& error) {
    throw NumericalError(function + ": " + error.what() + " for " + reproduce());
  }
}

/// Areas that are equal in exact arithmetic. Each is rounded once (to a multiple of the least
/// double, if it is tiny), so this only ever fails if an overlay is wrong.
inline void require_identity(const std::string& function, double area, double expected,
                             double operands) {
  if (std::abs(area - expected) <= 1e-14 * operands + std::numeric_limits<double>::min()) return;
  throw NumericalError(function + ": the area " + text_of(area) +
                       " m2 contradicts the areas that it is made of, which give " +
                       text_of(expected) + " m2");
}

}  // namespace palpation
