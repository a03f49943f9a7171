/// A start for flattening: the least-squares conformal map.
#pragma once

#include <optional>

#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

/// Angles kept as well as can be, borders free (Levy et al. 2002, CGAL's LSCM), counter-clockwise
/// as a whole; of any size and place. None where CGAL finds none. Single triangles may be turned
/// over. The mesh is a disk.
std::optional<Points2> conformal_map(const TriangleMesh& mesh);

}  // namespace palpation
