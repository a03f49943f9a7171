/// A start for flattening that never turns a triangle over.
#pragma once

#include <vector>

#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

/// The border around a circle in proportion to its length, every inner vertex at the mean of its
/// neighbours (Tutte 1963): no triangle of a disk is turned over, though in long meshes some are so
/// thin that rounding may. `border` as Surface::border_loops gives it.
Points2 circle_map(const TriangleMesh& mesh, const std::vector<int>& border);

}  // namespace palpation
