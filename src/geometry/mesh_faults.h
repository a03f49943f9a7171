/// What keeps a mesh from being a surface, counted: Surface names only the first fault that it
/// meets.
#pragma once

#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

struct MeshFaults {
  int flat_triangles = 0;    ///< without an area that is more than rounding
  int crowded_edges = 0;     ///< in more than two triangles
  int one_way_edges = 0;     ///< of two triangles that run through in the same direction
  int pinched_vertices = 0;  ///< whose triangles hang together in more than one fan
  bool any() const { return flat_triangles + crowded_edges + one_way_edges + pinched_vertices > 0; }
};

/// Throws InvalidInput if a triangle has a vertex that does not exist, or one twice.
MeshFaults count_faults(const TriangleMesh& mesh);

}  // namespace palpation
