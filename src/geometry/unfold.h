/// Developable meshes, laid flat exactly.
#pragma once

#include <optional>

#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

/// Coordinates in the plane that keep every edge's length to 1e-9 of it, triangles
/// counter-clockwise: triangle by triangle from the first, across the edges that they share. None
/// where the mesh does not unfold so. `neighbours` as in Connectivity; the mesh is a disk.
std::optional<Points2> unfold(const TriangleMesh& mesh, const Triangles& neighbours);

}  // namespace palpation
