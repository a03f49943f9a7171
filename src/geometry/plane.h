/// Flat surfaces and their chart.
#pragma once

#include "geometry/surface_state.h"
#include "palpation/geometry/chart.h"

namespace palpation {

/// Whether all vertices are in one plane to 1e-6 of the diameter and all faces look the same way.
Plane find_plane(const TriangleMesh& mesh, double diameter);

/// The area of a face times its outward normal.
Vec3 area_vector(const TriangleMesh& mesh, Eigen::Index face);

/// Of the surface, each triangle weighing as much as its area.
Vec3 centroid(const TriangleMesh& mesh);

/// The direction of u for a tangent plane: the mesh's x axis in it, or y where x is within 10
/// degrees of the unit normal.
Vec3 first_axis(const Vec3& normal);

/// The frame of chart.h, for a mesh in that plane.
Chart lay_flat(const TriangleMesh& mesh, const Plane& plane, double diameter);

}  // namespace palpation
