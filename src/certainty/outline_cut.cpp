#include "certainty/outline_cut.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "base/normal.h"

namespace palpation {
namespace {

/// Radii are about as long as what a probe feels is wide: that of the field's length.
constexpr double kRadius_m = 0.0035, kRadiusLogSd = 0.4;
constexpr double kHalfLength_m = 0.002;  ///< mean of an exponential law

Vec2 direction_at(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace

double log_cut_density(const OutlineCut& cut) {
  if (cut.offset.squaredNorm() > 1.0 || cut.half_length_m < 0.0)
    return -std::numeric_limits<double>::infinity();
  return -half_square((cut.log_radius - std::log(kRadius_m)) / kRadiusLogSd) -
         cut.half_length_m / kHalfLength_m;
}

OutlineCut drawn_cut(int anchor, const Vec2& anchor_place, Random& random) {
  OutlineCut cut{.is_present = true, .anchor = anchor, .anchor_place = anchor_place};
  cut.offset =
      std::sqrt(random.uniform()) * direction_at(2.0 * std::numbers::pi * random.uniform());
  cut.log_radius = std::log(kRadius_m) + kRadiusLogSd * random.normal();
  cut.half_length_m = -kHalfLength_m * std::log1p(-random.uniform());
  cut.angle = 2.0 * std::numbers::pi * random.uniform();
  return cut;
}

}  // namespace palpation
