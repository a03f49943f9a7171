/// Polygons in space as triangles, also those that none of their corners sees as a whole. Private
/// to the reading of meshes.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "palpation/base/types.h"

namespace palpation {

/// Triangles of a polygon's corners, counted from 0, that cover it once and turn as it does: the
/// constrained Delaunay triangulation as seen along the axis nearest to its mean normal, by CGAL.
/// The polygon need not be flat. Empty where it has no area, or crosses or touches itself as seen
/// from there: it has no inside then.
std::vector<std::array<int, 3>> cut_polygon(std::span<const Vec3> corners);

}  // namespace palpation
