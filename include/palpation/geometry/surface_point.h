/// A place on a surface: the one representation that is used everywhere.
#pragma once

#include "palpation/base/types.h"

namespace palpation {

/// The point sum_i barycentric[i] * (corner i of the face). The weights are at least 0 and add up
/// to 1.
struct SurfacePoint {
  int face = 0;
  Vec3 barycentric = Vec3(1.0, 0.0, 0.0);
};

}  // namespace palpation
