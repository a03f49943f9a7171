/// Triangles with all or some of the points as vertices, by CGAL: private to the making of a
/// surface from points.
#pragma once

#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

/// Delaunay's triangulation of the points as seen along a direction, counter-clockwise from where
/// it points. Points behind another are in no triangle. No triangles where all lie on one line.
Triangles triangulate_along(const Points& points, const Vec3& direction);

/// Advancing front (Cohen-Steiner and Da 2004): triangles of the three-dimensional Delaunay
/// triangulation, the most plausible first. An oriented manifold, closed or with borders.
Triangles advance_front(const Points& points);

/// Every point moved onto the quadric through its `neighbours` nearest (Cazals and Pouget 2005).
Points smooth_by_jets(const Points& points, int neighbours);

/// The same surface in triangles whose edges are about edge_m long, borders too (Botsch and Kobbelt
/// 2004). Takes a manifold, oriented mesh.
TriangleMesh remesh(const TriangleMesh& mesh, double edge_m);

}  // namespace palpation
