#include "certainty/outline_core.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "certainty/own_parts.h"

namespace palpation {
namespace {

/// Of the tumour's radius, the core's, median; a factor of four either way is within two sd.
constexpr double kOfTumour = 0.5, kCoreLogSd = 0.7;

}  // namespace

double least_beside(double fraction) { return kLeastCut * fraction / 0.5; }

double log_core_density(const OutlineCore& core, const Vec2& tumour_middle, double tumour_radius_m,
                        double fraction) {
  if (core.half_length_m < 0.0 || !(core.beside >= least_beside(fraction) && core.beside <= 1.0))
    return -std::numeric_limits<double>::infinity();
  const double median = kOfTumour * tumour_radius_m,
               z = (core.log_radius - std::log(median)) / kCoreLogSd,
               square = tumour_radius_m * tumour_radius_m;
  const double log_middle = -0.5 * (core.middle - tumour_middle).squaredNorm() / square -
                            std::log(2.0 * std::numbers::pi * square),
               log_radius = -0.5 * z * z - std::log(kCoreLogSd * std::sqrt(2.0 * std::numbers::pi)),
               log_length = -core.half_length_m / median - std::log(median);
  return log_middle + log_radius + log_length - std::log(1.0 - least_beside(fraction));
}

}  // namespace palpation
