/// Walking over the tissue from one place to another.
#pragma once

#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// Places every step_m along the way from `from` to `to`, both left out: the straight line on flat
/// tissue, elsewhere and around holes the shortest path along the surface. Only where no way leads
/// along the surface, between two components, the straight line through space is projected to it.
/// Throws InvalidInput unless step_m is positive and finite.
std::vector<SurfacePoint> way_between(const Surface& surface, const SurfacePoint& from,
                                      const SurfacePoint& to, double step_m);

}  // namespace palpation
