/// One form for each place, which survives a file.
#pragma once

#include "palpation/geometry/surface.h"

namespace palpation {

/// The same place, to a billionth of its triangle: weights are multiples of 2^-30, and what lies on
/// an edge or at a vertex is a point of the lowest face there. Settled, a point that was written as
/// its position and projected back to the surface is the same point, bit for bit.
SurfacePoint settled_point(const Surface& surface, const SurfacePoint& point);

}  // namespace palpation
