#include "certainty/outline_amendment.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "certainty/outline_model.h"

namespace palpation {
namespace {

/// Radii are about as long as what a probe feels is wide: that of the field's length.
constexpr double kRadius_m = 0.0035, kRadiusLogSd = 0.4;
constexpr double kHalfLength_m = 0.002;  ///< mean of an exponential law

double half_square(double z) { return 0.5 * z * z; }

Vec2 direction_at(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace

double Amendment::depth_at(const Vec2& place) const {
  const double radius = std::exp(log_radius);
  const Vec2 middle = anchor_place + radius * offset, half = half_length_m * direction_at(angle);
  return radius - std::sqrt(squared_distance(place, middle - half, middle + half));
}

double log_amendment_density(const Amendment& amendment) {
  if (amendment.offset.squaredNorm() > 1.0 || amendment.half_length_m < 0.0)
    return -std::numeric_limits<double>::infinity();
  return -half_square((amendment.log_radius - std::log(kRadius_m)) / kRadiusLogSd) -
         amendment.half_length_m / kHalfLength_m -
         half_square(amendment.log_contrast / kContrastLogSd);
}

Amendment drawn_amendment(int anchor, const Vec2& anchor_place, Random& random) {
  Amendment amendment{.is_present = true, .anchor = anchor, .anchor_place = anchor_place};
  amendment.adds = random.below(2) == 0;
  amendment.offset =
      std::sqrt(random.uniform()) * direction_at(2.0 * std::numbers::pi * random.uniform());
  amendment.log_radius = std::log(kRadius_m) + kRadiusLogSd * random.normal();
  amendment.half_length_m = -kHalfLength_m * std::log1p(-random.uniform());
  amendment.angle = 2.0 * std::numbers::pi * random.uniform();
  amendment.log_contrast = kContrastLogSd * random.normal();
  return amendment;
}

}  // namespace palpation
