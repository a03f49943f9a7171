/// How sure the belief is of the boundary, at hyperparameters taken as they are.
#pragma once

#include "palpation/belief/belief.h"
#include "palpation/belief/level.h"

namespace palpation {

/// Probability that the field is at least the level, at each vertex: Phi((mean - h) / sqrt(variance
/// + sd_h^2)); where both are sure, 1 or 0 by the half-open rule. A level without a standard
/// deviation counts as exact.
Field probability_inside(const Marginals& marginals, const Level& level);

/// Expected area on the wrong side of the boundary { mean = h }: the paper's error, predicted
/// without the truth. Each vertex stands for a third of the faces around it.
struct ExpectedError {
  double missed_m2 = 0.0;
  double extra_m2 = 0.0;
  double symmetric_difference_m2() const { return missed_m2 + extra_m2; }
};
ExpectedError expected_error(const Surface& surface, const Marginals& marginals,
                             const Level& level);

}  // namespace palpation
