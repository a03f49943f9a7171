/// The same tissue with fewer vertices, for what need not be known everywhere.
#pragma once

#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

struct CoarseMesh {
  TriangleMesh mesh;
  std::vector<int>
      vertices;  ///< for each of its vertices, the same one of the fine surface; rising
};

/// Collapses edges shorter than edge_m, the shortest first, each into one of its ends: what is left
/// are vertices of the surface, about edge_m to 1.5 edge_m apart. Corners of the border stay, and
/// no face turns by more than 20 degrees from the surface's normals, so that curved tissue keeps
/// the vertices it needs. The number of components, borders and handles stays the same. Throws
/// InvalidInput unless edge_m is positive and finite.
CoarseMesh coarsen(const Surface& surface, double edge_m);

}  // namespace palpation
