/// Exact distances along a triangle mesh, by CGAL: slow, and the twin of what the library does.
#pragma once

#include <span>

#include "palpation/geometry/surface_point.h"
#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

/// From every vertex of a valid mesh to the nearest source, by unfolding (Xin and Wang 2009);
/// infinite where none can be reached.
Field unfold_distances(const TriangleMesh& mesh, std::span<const SurfacePoint> sources);

}  // namespace palpation
