/// A part of an organ to work on.
#pragma once

#include "palpation/geometry/surface.h"

namespace palpation {

/// The triangles all of whose vertices lie within radius_m of the surface point nearest to `centre`, walking along the surface; of these,
/// the component around that point. Vertices and triangles keep their order; a vertex where the patch only touches itself is split in two,
/// so that the patch is always a valid surface. Throws InvalidInput if the radius is not positive and finite, or if no triangle is left.
TriangleMesh patch_around(const Surface& surface, const Vec3& centre, double radius_m);

}  // namespace palpation
