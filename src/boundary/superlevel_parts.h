/// The parts of { field >= level }, by their vertices.
#pragma once

#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// Two vertices of an edge that both reach the level are of one part. Parts by their first vertex,
/// vertices rising.
std::vector<std::vector<int>> superlevel_parts(const Surface& surface, const Field& field,
                                               double level);

}  // namespace palpation
