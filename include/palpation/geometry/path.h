/// Walking over the tissue from one place to another.
#pragma once

#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// Places every step_m along the way from `from` to `to`, both left out. The way is where the plane through both and the mean of their
/// normals cuts the surface: the straight line on flat tissue. Where that cut does not lead there (a hole, a border, a fold), the straight
/// line through space is projected to the surface. Throws InvalidInput unless step_m is positive and finite.
std::vector<SurfacePoint> way_between(const Surface& surface, const SurfacePoint& from, const SurfacePoint& to, double step_m);

}  // namespace palpation
