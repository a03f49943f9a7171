#include "palpation/certainty/reference_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "base/normal.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

/// Of outline that one mode stands for: what is smoother than this is known of tumours, what is
/// finer is not asked for.
constexpr double kModeLength_m = 0.0045;

void check(const ReferenceCase& of) {
  const auto check_positive = [](const std::string& what, double value) {
    require(std::isfinite(value) && value > 0.0, "reference_bound", what + " = " + text_of(value),
            "must be positive and finite");
  };
  check_positive("perimeter_m", of.perimeter_m);
  check_positive("slope_per_m", of.slope_per_m);
  require(std::isfinite(of.noise) && of.noise >= 0.0, "reference_bound",
          "noise = " + text_of(of.noise), "must be finite and not negative");
  require(of.readings > 0, "reference_bound", "readings = " + std::to_string(of.readings),
          "must be positive");
  require(of.fraction > 0.0 && of.fraction < 1.0, "reference_bound",
          "fraction = " + text_of(of.fraction), "must lie in (0, 1)");
}

/// Readings at the boundary tell P offsets of the line at the level; those on the plateaus, shared
/// between low and high as 1 - f to f, the level itself.
double with_best_split(int modes) {
  constexpr int kParts = 20;
  double least = std::numeric_limits<double>::infinity();
  for (int part = 1; part < kParts; ++part) {
    const double share = static_cast<double>(part) / kParts;
    least = std::min(least, modes / (1.0 - share) + 1.0 / share);
  }
  return least;
}

}  // namespace

double ReferenceBound::band_half_width_m(double probability) const {
  require(probability > 0.0 && probability < 1.0, "band_half_width_m",
          "probability = " + text_of(probability), "must lie in (0, 1)");
  return offset_sd_m * normal_quantile(0.5 + 0.5 * std::pow(probability, 1.0 / modes));
}

ReferenceBound reference_bound(const ReferenceCase& of) {
  check(of);
  ReferenceBound bound;
  bound.modes = static_cast<int>(std::max(1.0, std::round(of.perimeter_m / kModeLength_m)));
  const double by_one_reading_m = of.noise / (of.slope_per_m * of.fraction * (1.0 - of.fraction));
  const double readings_worth = of.plateaus_known ? bound.modes : with_best_split(bound.modes);
  bound.offset_sd_m = by_one_reading_m * std::sqrt(readings_worth / of.readings);
  bound.expected_error_m2 = of.perimeter_m * std::sqrt(2.0 / std::numbers::pi) * bound.offset_sd_m;
  return bound;
}

}  // namespace palpation
