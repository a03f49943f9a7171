/// Borders and kind of a surface, by walks on its half-edge mesh.
#pragma once

#include <vector>

#include "geometry/check_mesh.h"
#include "geometry/half_edge_mesh.h"
#include "palpation/geometry/surface.h"

namespace palpation {

/// As Surface::border_loops promises.
std::vector<std::vector<int>> walk_borders(const HalfEdgeMesh& mesh);

Topology count_topology(const HalfEdgeMesh& mesh, const Triangles& neighbours, int border_count);

}  // namespace palpation
