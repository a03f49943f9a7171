/// Flat phantoms.
#pragma once

#include "palpation/base/random.h"
#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

/// A rectangle in the plane z = 0 from `corner`, columns x rows vertices spread evenly, two
/// triangles a cell, every second diagonal turned (the other way where strong jitter would turn a
/// triangle over).
struct PlaneOptions {
  Vec2 size_m = Vec2(0.025, 0.050);
  int columns = 200;
  int rows = 200;
  Vec2 corner_m = Vec2::Zero();
  double jitter = 0.0;  ///< inner vertices move by up to this fraction of a cell, each way; below
                        ///< 0.5, and border vertices along the border only
};

/// Throws InvalidInput unless sizes are positive and finite, columns and rows at least 2, at most
/// 2^27 vertices in all, jitter in [0, 0.45].
TriangleMesh make_plane(const PlaneOptions& options, Random& random);

}  // namespace palpation
