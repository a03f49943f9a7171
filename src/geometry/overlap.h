/// Flat meshes that lie over themselves.
#pragma once

#include <optional>
#include <vector>

#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

/// A place where two triangles of a mesh cover the same part of the plane, if there is one. All
/// triangles must run counter-clockwise in uv; then the border runs around a place as often as
/// triangles cover it. So where two sheets overlap, either a border edge crosses the inner side of
/// another, or no edges cross and a whole loop lies on the other sheet: only borders are looked at.
/// `neighbours` as in Connectivity. Triangles that touch or meet at a crack do not overlap, nor do
/// some that only do so by a millionth of their height.
std::optional<Vec2> place_of_overlap(const Triangles& triangles, const Triangles& neighbours,
                                     const std::vector<std::vector<int>>& border_loops,
                                     const Points2& uv);

}  // namespace palpation
