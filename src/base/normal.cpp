#include "base/normal.h"

#include <boost/math/special_functions/owens_t.hpp>
#include <cmath>
#include <numbers>

namespace palpation {

double normal_probability(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

/// By bisection in the lower half, where the probability keeps its digits.
double normal_quantile(double probability) {
  if (probability > 0.5) return -normal_quantile(1.0 - probability);
  double below = -40.0, above = 0.0;
  for (double middle = -20.0; below < middle && middle < above;
       middle = below + 0.5 * (above - below)) {
    (normal_probability(middle) < probability ? below : above) = middle;
  }
  return above;
}

/// Boost's, but for what it takes for infinity times nothing.
double owens_t(double h, double a) {
  if (std::isinf(a)) return std::copysign(0.5 * normal_probability(-std::abs(h)), a);
  using namespace boost::math::policies;
  return boost::math::owens_t(h, a, policy<promote_double<false>>());
}

}  // namespace palpation
