/// Points spread over a surface.
#pragma once

#include <vector>

#include "palpation/base/random.h"
#include "palpation/geometry/surface.h"

namespace palpation {

/// Independent points, uniform by area. Throws InvalidInput if count is negative.
std::vector<SurfacePoint> sample_uniformly(const Surface& surface, int count, Random& random);

}  // namespace palpation
