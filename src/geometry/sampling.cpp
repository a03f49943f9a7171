#include "palpation/geometry/sampling.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "palpation/base/error.h"

namespace palpation {
namespace {

std::vector<double> cumulative_areas(const Surface& surface) {
  std::vector<double> cumulative(surface.face_count());
  double sum = 0.0;
  for (int f = 0; f < surface.face_count(); ++f) cumulative[f] = sum += surface.face_area(f);
  return cumulative;
}

/// Uniform in a triangle (Osada et al. 2002).
Vec3 uniform_weights(Random& random) {
  const double root = std::sqrt(random.uniform());
  const double share = random.uniform();
  const double second = root * (1.0 - share), third = root * share;
  return {std::max(0.0, 1.0 - second - third), second, third};
}

}  // namespace

std::vector<SurfacePoint> sample_uniformly(const Surface& surface, int count, Random& random) {
  require(count >= 0, "sample_uniformly", "count " + std::to_string(count), "must not be negative");
  const std::vector<double> cumulative = cumulative_areas(surface);
  std::vector<SurfacePoint> points;
  points.reserve(count);
  for (int k = 0; k < count; ++k) {
    const auto found = std::upper_bound(cumulative.begin(), cumulative.end(),
                                        random.uniform() * cumulative.back());
    const int face = static_cast<int>(
        std::min(found - cumulative.begin(), static_cast<std::ptrdiff_t>(cumulative.size()) - 1));
    points.push_back({face, uniform_weights(random)});
  }
  return points;
}

}  // namespace palpation
