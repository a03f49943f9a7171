/// Fast distances along a triangle mesh, good to a percent.
#pragma once

#include <span>
#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// The shapes of a surface's faces, laid out once for many fronts.
///
/// A corner c of a face whose corners a and b are reached gets the distance from the place s of the
/// face's plane that is as far from a and b as they are from the source, if the line from s to c
/// crosses ab; else the way along an edge. A corner is corrected when a shorter way comes later, so
/// obtuse faces need no special care. On flat faces this is exact until light bends.
class Marching {
 public:
  /// The surface must outlive it.
  explicit Marching(const Surface& surface);

  /// From a source to each target; infinite where none can be reached. The front goes no farther
  /// than to the last of them.
  std::vector<double> distances(const SurfacePoint& source,
                                std::span<const SurfacePoint> targets) const;

 private:
  friend class Front;

  /// Half-edge 3 f + i from the origin along x; the face's third corner is at (apex_x, apex_y),
  /// above it.
  struct Shape {
    double length, apex_x, apex_y, half_inverse;  // 1 / (2 length)
  };

  const Surface& surface_;
  std::vector<Shape> shapes_;
  std::vector<int> first_, leaving_;  // half-edges by the vertex that they leave:
                                      // leaving_[first_[v]] up to first_[v + 1]
};

}  // namespace palpation
