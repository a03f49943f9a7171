/// Whether there is room above the tissue.
#pragma once

#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// For every vertex: whether the straight line of this length along its normal meets none of the
/// faces but those around it; with a radius, whether a probe with a round tip of that radius comes
/// down that far to the vertex along its normal without touching tissue elsewhere: it may come as
/// near as 0.98 of its radius, since the mesh is not quite the tissue. Computes a search tree
/// ("clearance"; with a radius also "search tree"). Throws InvalidInput unless the length is
/// positive and finite, the radius finite and not negative.
std::vector<bool> clear_vertices(const Surface& surface, double length_m, double radius_m = 0.0);

}  // namespace palpation
