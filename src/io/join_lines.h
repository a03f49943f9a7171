/// Lines as other programs write outlines, piece by piece, made whole. Private to this folder.
#pragma once

#include <vector>

#include "io/mesh_source.h"
#include "palpation/base/types.h"

namespace palpation {

using Line = std::vector<int>;  ///< numbers of points

/// The closed lines that the lines make together, their first points not repeated. Ends join where
/// their points are in the same place; what joins there in which order does not matter to what is
/// inside an odd number of them. Throws IoError, naming the line and the place, where one ends and
/// no other goes on.
std::vector<Line> joined_lines(const MeshSource& source, const std::vector<Vec3>& points,
                               const std::vector<Line>& lines);

}  // namespace palpation
