/// Fast distances along a triangle mesh, good to a percent.
#pragma once

#include <span>
#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// From a source to each target; infinite where none can be reached. The front goes no farther than to the last of them.
///
/// A corner c of a face whose corners a and b are reached gets the distance from the place s of the face's plane that is as far from a and
/// b as they are from the source, if the line from s to c crosses ab; else the way along an edge. A corner is corrected when a shorter way
/// comes later, so obtuse faces need no special care. On flat faces this is exact until light bends.
std::vector<double> marched_distances(const Surface& surface, const SurfacePoint& source, std::span<const SurfacePoint> targets);

}  // namespace palpation
