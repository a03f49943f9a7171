/// From space to the chart of planar tissue, which is its plane: a rigid motion, so no search is
/// needed.
#pragma once

#include <cmath>

#include "palpation/geometry/chart_place.h"
#include "palpation/geometry/surface.h"

namespace palpation {

/// Defined for every point of space, also beyond the tissue's border. Requires surface.is_planar().
class PlaneMap {
 public:
  explicit PlaneMap(const Surface& surface);

  Vec2 place(const Vec3& position) const { return origin_uv_ + direction(position - origin_); }
  Vec2 direction(const Vec3& vector) const {
    return u_.transpose() * vector * axis_u_ + v_.transpose() * vector * axis_v_;
  }
  double height(const Vec3& position) const { return normal_.dot(position - origin_); }

 private:
  // Two orthonormal directions in space and the same two in the chart.
  Vec3 origin_, u_, v_, normal_;
  Vec2 origin_uv_, axis_u_, axis_v_;
};

/// A place of a chart to the next multiple of 2^-40 m, about a picometre: what lies on one line
/// before rounding does so after it, so that rows of readings and sides of outlines are straight
/// for exact predicates too.
inline Vec2 snapped(const Vec2& place) {
  const auto snap = [](double coordinate_m) { return std::round(coordinate_m * 0x1p40) * 0x1p-40; };
  return {snap(place.x()), snap(place.y())};
}

/// Where a point of the surface lies in its chart, snapped.
inline Vec2 snapped_place(const Surface& surface, const SurfacePoint& point) {
  return snapped(chart_place(surface, point));
}

}  // namespace palpation
