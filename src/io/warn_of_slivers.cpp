#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "io/polygon_soup.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

// Below it, a float's seven digits say nothing of the height; doubles still do.
constexpr double kSmallestAngle = 1e-6;

/// Squared sine of the smallest angle of a triangle with these two sides: it lies between the two
/// longest.
double squared_sine(const Vec3& ab, const Vec3& ac) {
  const double first = ab.squaredNorm(), second = ac.squaredNorm(), third = (ac - ab).squaredNorm();
  const double two_longest = first <= second && first <= third ? second * third
                             : second <= third                 ? first * third
                                                               : first * second;
  return two_longest > 0.0 ? ab.cross(ac).squaredNorm() / two_longest : 0.0;
}

/// Brings the longest side of the bounding box near 1, so that fourth powers are numbers.
double scale_of(const PolygonSoup& soup) {
  Vec3 low = soup.points.front(), high = low;
  for (const Vec3& point : soup.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return 0.5 / (0.5 * high - 0.5 * low).maxCoeff();
}

}  // namespace

void warn_of_slivers(PolygonSoup& soup, const std::vector<SoupTriangle>& triangles) {
  const double scale = scale_of(soup);
  if (!std::isfinite(scale)) return;
  const auto side = [&](int from, int to) -> Vec3 {
    return scale * (soup.points[to] - soup.points[from]);
  };
  std::int64_t count = 0;
  double worst = 1.0;
  int worst_face = 0;
  for (const SoupTriangle& triangle : triangles) {
    const double sine = squared_sine(side(triangle.corners[0], triangle.corners[1]),
                                     side(triangle.corners[0], triangle.corners[2]));
    if (!(sine < kSmallestAngle * kSmallestAngle)) continue;
    ++count;
    if (sine < worst) worst_face = triangle.face;
    worst = std::min(worst, sine);
  }
  if (count == 0) return;
  soup.warn(std::to_string(count) +
                " triangles are slivers, with an angle below 1e-6 rad; the worst is in face " +
                std::to_string(worst_face + soup.first_number) + ", with " +
                text_of(std::sqrt(worst)) + " rad.",
            "Their normals are rounding. Collapse their short edges or remesh; those without any "
            "area must go.");
}

}  // namespace palpation
