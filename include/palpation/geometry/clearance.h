/// Whether there is room above the tissue.
#pragma once

#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// For every vertex: whether the straight line of this length along its normal meets none of the faces but those around it. Computes a
/// search tree of its own ("clearance"). Throws InvalidInput unless the length is positive and finite.
std::vector<bool> clear_vertices(const Surface& surface, double length_m);

}  // namespace palpation
