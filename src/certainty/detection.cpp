#include "palpation/certainty/detection.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "certainty/normal.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kResolution_m = 1e-5;

class Power {
 public:
  Power(const Surface& surface, std::span<const Vec3> places, const Sought& sought)
      : surface_(surface),
        places_(places),
        slope_per_m_(sought.slope_per_m),
        needed_(std::pow((kNeededToFind + normal_quantile(sought.probability)) / sought.contrast_to_noise, 2)) {}

  /// Whether a disk around a vertex is found surely enough. It grows with the radius.
  bool suffices(int vertex, double radius_m) const {
    const Vec3 centre = surface_.vertex(vertex);
    double sum = 0.0;
    bool touched = false;
    for (const Vec3& place : places_) {
      const double depth = radius_m - (place - centre).norm();
      if (depth < 0.0) continue;
      touched = true;
      const double rise = 1.0 / (1.0 + std::exp(-slope_per_m_ * depth));
      sum += rise * rise;
      if (sum >= needed_) return true;
    }
    return touched && sum >= needed_;
  }

 private:
  const Surface& surface_;
  std::span<const Vec3> places_;
  double slope_per_m_;
  double needed_;
};

}  // namespace

std::optional<double> diameter_ruled_out_m(const Surface& surface, std::span<const Vec3> places, const Sought& sought) {
  require(sought.contrast_to_noise > 0.0, "diameter_ruled_out_m", "contrast_to_noise = " + text_of(sought.contrast_to_noise),
          "must be positive");
  require(std::isfinite(sought.slope_per_m) && sought.slope_per_m > 0.0, "diameter_ruled_out_m",
          "slope_per_m = " + text_of(sought.slope_per_m), "must be positive and finite");
  require(sought.probability > 0.0 && sought.probability < 1.0, "diameter_ruled_out_m", "probability = " + text_of(sought.probability),
          "must lie in (0, 1)");
  const Power power(surface, places, sought);
  double radius_m = 0.0;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    if (power.suffices(vertex, radius_m)) continue;
    double too_small = radius_m, enough = surface.diameter();
    if (!power.suffices(vertex, enough)) return std::nullopt;
    while (enough - too_small > kResolution_m) {
      const double middle = 0.5 * (too_small + enough);
      (power.suffices(vertex, middle) ? enough : too_small) = middle;
    }
    radius_m = enough;
  }
  return 2.0 * radius_m;
}

}  // namespace palpation
