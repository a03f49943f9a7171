/// A part of a surface as a mesh of its own.
#pragma once

#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// Vertices and triangles keep their order. A vertex at which the part only touches itself is
/// split, so that the part is again a valid surface.
struct CutOut {
  TriangleMesh mesh;
  std::vector<int> faces;     ///< the surface's face of each triangle, increasing
  std::vector<int> vertices;  ///< the surface's vertex of each vertex, not falling
};

/// Of the faces to keep, those that hang together by edges with the seed, which must be one of
/// them.
CutOut cut_out(const Surface& surface, const std::vector<bool>& keep, int seed);

}  // namespace palpation
