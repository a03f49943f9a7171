#include "certainty/lean.h"

#include <cmath>
#include <numbers>

namespace palpation {
namespace {

/// Half of the edges are at most 1.4 times as steep towards their side as in the middle: of two
/// numbers the law's median is 2^(1/2) of their scale. Fourier's coefficients of an edge that
/// changes smoothly fall at least as one over their number.
constexpr double kOnce = 0.25, kTwice = 0.5 * kOnce;

const Lean kScale = {kOnce, kOnce, kTwice, kTwice};

}  // namespace

double log_steepness(const Lean& lean, const Vec2& off_m, double radius_m) {
  const Vec2 side = off_m / std::sqrt(off_m.squaredNorm() + radius_m * radius_m);
  const double along = side.x() * side.x() - side.y() * side.y(),
               across = 2.0 * side.x() * side.y();
  return lean.dot(Lean(side.x(), side.y(), along, across));
}

double log_density(const Lean& lean) {
  const double square = lean.cwiseQuotient(kScale).squaredNorm();
  return -3.0 * std::log1p(0.5 * square) -
         std::log(2.0 * std::numbers::pi * std::numbers::pi * kScale.prod());
}

Lean draw_lean(Random& random) {
  Lean lean;
  for (double& number : lean) number = random.normal();
  // Half of a chi square of two degrees of freedom is exponential.
  return lean.cwiseProduct(kScale) / std::sqrt(-std::log1p(-random.uniform()));
}

}  // namespace palpation
