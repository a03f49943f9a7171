/// The loops of a level set as curves of a file, sorted into parts and holes.
#pragma once

#include <vector>

#include "palpation/geometry/surface.h"
#include "palpation/io/write_vtp.h"

namespace palpation::tool {

/// Loops of { field >= level }. Parts are numbered by falling area of their outer loop in the
/// chart; a hole bears the number of the part around it.
std::vector<BoundaryCurve> boundary_curves(const Surface& surface, const Field& field, double level,
                                           CurveKind kind);

}  // namespace palpation::tool
