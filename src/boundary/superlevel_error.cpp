#include "boundary/above_level.h"
#include "boundary/convex.h"
#include "palpation/boundary/region_error.h"

namespace palpation {
namespace {

/// A face in coordinates of its own, of area 1/2, and a field in them that is linear over it.
const Vec2 kA(0.0, 0.0), kB(1.0, 0.0), kC(0.0, 1.0);

struct Linear {
  Vec3 at_corners;
  double operator()(const Vec2& p) const {
    return (1.0 - p.x() - p.y()) * at_corners[0] + p.x() * at_corners[1] + p.y() * at_corners[2];
  }
};

double share(const Convex& part) { return 2.0 * part.area(); }

}  // namespace

RegionError compare(const Surface& surface, const Superlevel& estimate, const Superlevel& truth) {
  require_field(surface, estimate.field, estimate.level, "compare");
  require_field(surface, truth.field, truth.level, "compare");
  double both = 0.0, only_estimate = 0.0, only_truth = 0.0;
  for (int face = 0; face < surface.face_count(); ++face) {
    const Linear a{above_level(surface, estimate.field, estimate.level, face)},
        b{above_level(surface, truth.field, truth.level, face)};
    const auto outside = [](const Linear& field) { return Linear{-field.at_corners}; };
    const bool no_a = a.at_corners.maxCoeff() < 0.0, no_b = b.at_corners.maxCoeff() < 0.0;
    if (no_a && no_b) continue;
    const double area = surface.face_area(face);
    const auto cut_twice = [&](const Linear& one, const Linear& other) {
      Convex part(kA, kB, kC);
      part.cut(one);
      part.cut(other);
      return share(part) * area;
    };
    both += cut_twice(a, b);
    // A face wholly at the level is inside: there is nothing of it outside.
    if (!no_a && b.at_corners.minCoeff() < 0.0) only_estimate += cut_twice(a, outside(b));
    if (!no_b && a.at_corners.minCoeff() < 0.0) only_truth += cut_twice(b, outside(a));
  }
  RegionError error;
  error.missed_m2 = only_truth;
  error.extra_m2 = only_estimate;
  error.symmetric_difference_m2 = only_truth + only_estimate;
  const double sum = 2.0 * both + error.symmetric_difference_m2;
  if (sum > 0.0) error.dice = 2.0 * both / sum;
  return error;
}

}  // namespace palpation
