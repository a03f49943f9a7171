/// Tissue that goes on beyond its border.
///
/// A heat kernel feels a border: on it, heat that cannot leave doubles. So the surface is extended
/// before its Laplacian is built, flat and by lengths alone. Notches of the border are filled with
/// flat triangles until it is convex (or the triangles would be wider than twice the margin, so
/// that a hole closes if it is that narrow); around that lie rings of flat strips, one beside every
/// border edge, and a wedge at every convex corner. Where the surface is planar that is its own
/// plane, exactly. The rings are as wide as the border's edges at first and then a fixed part of
/// their distance from it: what is far away only matters to long waves.
#pragma once

#include "geometry/laplacian.h"

namespace palpation {

/// The mesh with a margin of that width, m, along every border. Its own vertices and triangles come
/// first, in their order.
MetricMesh with_margin(const MetricMesh& mesh, const std::vector<std::vector<int>>& border_loops,
                       double width);

}  // namespace palpation
