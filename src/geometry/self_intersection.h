/// Where a surface runs through itself: triangles that meet elsewhere than in the corners and edges
/// they have in common.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "palpation/geometry/surface.h"

namespace palpation {

struct SelfIntersections {
  std::int64_t pairs = 0;                   ///< of triangles
  std::optional<std::array<int, 2>> first;  ///< the lowest pair
  bool complete =
      true;  ///< false where so many triangles are close together that the search was given up
};

/// Exact for the coordinates as doubles. Corners at the same place count as the same, so a seam is
/// no intersection; two sheets that touch in one point are. Looks at no more pairs than a hundred
/// for each triangle, whose bounding boxes meet: sound tissue has about ten.
SelfIntersections self_intersections(const Surface& surface);

}  // namespace palpation
