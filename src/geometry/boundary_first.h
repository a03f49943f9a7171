/// A start for flattening: the conformal map that leaves the border's lengths as they are.
#pragma once

#include <optional>
#include <vector>

#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

/// Of all conformal maps the one that stretches least, after Sawhney and Crane (2017): the border
/// gets the curvature that is left over when all inside is flat, keeps its lengths but for what it
/// takes to close, and the rest is spanned harmonically. Counter-clockwise, in the mesh's lengths.
/// Single triangles may be turned over. None where a border edge would turn round. The mesh is a
/// disk, `border` its border with the tissue on the left.
std::optional<Points2> boundary_first_map(const TriangleMesh& mesh, const std::vector<int>& border);

}  // namespace palpation
