/// A part of an organ to work on.
#pragma once

#include <optional>

#include "palpation/geometry/surface.h"

namespace palpation {

/// The triangles all of whose vertices lie within radius_m of the surface point nearest to
/// `centre`, walking along the surface; of these, the component around that point. Vertices and
/// triangles keep their order; a vertex where the patch only touches itself is split in two, so
/// that the patch is always a valid surface. Throws InvalidInput if the radius is not positive and
/// finite, or if no triangle is left.
TriangleMesh patch_around(const Surface& surface, const Vec3& centre, double radius_m);

/// Which triangles a patch takes: those that pass all tests that are set.
struct PatchTests {
  struct Box {
    Vec3 least, most;
  };
  struct Facing {
    Vec3 direction;           ///< of any length: where one looks at the tissue from
    double within_rad = 0.0;  ///< of the triangle's normal
  };
  std::optional<Box> box{};  ///< all corners lie in it
  std::optional<Facing> facing{};
};

/// The triangles that pass; of these, the component that holds the one nearest to `centre` in a
/// straight line from its middle, or without a centre the one of the largest area (of equals, the
/// one with the lowest triangle). Otherwise as patch_around. Throws InvalidInput if the box is not
/// finite or empty, the direction not finite or zero, the angle not in (0, pi], or if no triangle
/// passes.
TriangleMesh patch_passing(const Surface& surface, const PatchTests& tests,
                           const std::optional<Vec3>& centre);

}  // namespace palpation
