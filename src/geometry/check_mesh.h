/// The contract of a Surface, checked before any mesh structure sees the triangles.
#pragma once

#include <vector>

#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

/// What the checks find out on their way.
struct Connectivity {
  Triangles neighbours;             ///< the face across the edge from corner i to corner i+1, or -1
  std::vector<int> face_of_vertex;  ///< the lowest
};

/// Whether a triangle has an area that is more than rounding: see surface.h.
bool has_area(const TriangleMesh& mesh, Eigen::Index face);
bool has_area(const Vec3& a, const Vec3& b, const Vec3& c);

/// Throws InvalidMesh, naming the first element at fault, its position and the rule of surface.h
/// that it breaks.
Connectivity check_mesh(const TriangleMesh& mesh);

}  // namespace palpation
