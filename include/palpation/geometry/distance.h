/// Distances along the surface.
#pragma once

#include <span>

#include "palpation/geometry/surface.h"

namespace palpation {

/// From every vertex to the nearest of the sources, walking along the surface; infinite where none can be reached. Exact for the mesh:
/// straight lines on a planar convex surface, else by unfolding sequences of faces (Xin and Wang 2009, CGAL's Surface_mesh_shortest_path).
/// Unfolding takes 0.2 s for 2,500 vertices and grows nearly with their square: 25 s for 40,000.
/// Throws InvalidInput without sources or if one is no point of the surface, NumericalError if unfolding fails.
Field distance_from(const Surface& surface, std::span<const SurfacePoint> sources);

}  // namespace palpation
