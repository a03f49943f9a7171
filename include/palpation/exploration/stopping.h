/// When enough is known, before the batches are done.
#pragma once

#include <cstddef>
#include <span>

#include "palpation/certainty/certainty.h"

namespace palpation {

/// Every reason is off at 0.
struct StopRule {
  double error_m2 = 0.0;    ///< the expected symmetric difference is no larger
  double band_m = 0.0;      ///< the band's mean half width is no larger
  double least_gain = 0.0;  ///< the last three batches and the next one lower the expected error by
                            ///< less than this part of it
};

/// Throws InvalidInput unless error and band are not negative and the gain is in [0, 1].
void check(const StopRule& rule);

/// The expected error once these vertices are touched too, the level and the hyperparameters
/// staying as sure as they are: a vertex is then misjudged with probability 2 T(|score|, b / sqrt(1
/// - b^2)), T Owen's function and b the ratio of the score's standard deviations after and before.
/// Never more than now.
double expected_error_after(const Surface& surface, const Belief& belief, const Certainty& now,
                            const Level& level, std::span<const int> vertices);

/// Of the batches so far, how many `gains_too_little` looks at.
inline constexpr std::size_t kErrorsLookedAt = 4;

/// Whether the rule's least gain is missed. `errors_m2`: expected after each batch so far, the last
/// one now.
bool gains_too_little(const StopRule& rule, std::span<const double> errors_m2, const Certainty& now,
                      const Surface& surface, const Belief& belief, const Level& level,
                      std::span<const int> next);

}  // namespace palpation
