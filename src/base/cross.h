/// Of two vectors in the plane.
#pragma once

#include "palpation/base/types.h"

namespace palpation {

/// The area of the parallelogram from a to b, positive counter-clockwise.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace palpation
