/// Plain triangles, without promises: what files hold and what generators make. A Surface is made
/// from it, and checks it.
#pragma once

#include "palpation/base/types.h"

namespace palpation {

struct TriangleMesh {
  Points vertices;      ///< n x 3, metres
  Triangles triangles;  ///< m x 3, counter-clockwise seen from outside
};

/// Longest side of the axis-aligned bounding box, metres; 0 without vertices.
double extent_m(const TriangleMesh& mesh);

/// Linear 1-to-4 subdivision of all triangles, the geometry unchanged, until no edge is longer than
/// longest_edge_m. The old vertices come first. Throws InvalidInput unless longest_edge_m is
/// positive and finite, coordinates finite and indices in range, or if more than 2^27 triangles
/// would be needed.
TriangleMesh refine(TriangleMesh mesh, double longest_edge_m);

}  // namespace palpation
