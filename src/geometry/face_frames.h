/// A surface's faces laid flat, one at a time: half-edges, their frames, and the fan around a
/// vertex. Half-edge 3 f + i is side i of face f, from its corner i to the next.
#pragma once

#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// Half-edge 3 f + i in the plane of its face f: it runs from the origin to (length, 0), and the
/// third corner is at apex, above it.
struct EdgeFrame {
  double length;
  Vec2 apex;
};

/// A face in the fan around a vertex, which is its corner so numbered.
struct Blade {
  int face, corner;
  double start, angle;  // the face covers so much, from its edge to the next corner
};

/// The faces around a vertex, counter-clockwise; where there is a border, from it.
struct Fan {
  std::vector<Blade> blades;
  bool closes = false;
  double angle() const { return blades.back().start + blades.back().angle; }
};

class FaceFrames {
 public:
  /// The surface must outlive it.
  explicit FaceFrames(const Surface& surface)
      : surface_(surface),
        vertices_(surface.mesh().vertices),
        triangles_(surface.mesh().triangles) {}

  int start(int half_edge) const { return triangles_(half_edge / 3, half_edge % 3); }
  int end(int half_edge) const { return triangles_(half_edge / 3, (half_edge % 3 + 1) % 3); }
  int apex(int half_edge) const { return triangles_(half_edge / 3, (half_edge % 3 + 2) % 3); }
  int corner(int face, int corner) const { return triangles_(face, corner); }
  Vec3 place(int vertex) const { return vertices_.row(vertex); }
  Vec3 place(const SurfacePoint& point) const { return surface_.position(point); }

  EdgeFrame frame(int half_edge) const;
  /// A point of the half-edge's face in its frame.
  Vec2 in_frame(int half_edge, const EdgeFrame& frame, const Vec3& barycentric) const;
  /// The half-edge on the other side, -1 at a border.
  int opposite(int half_edge) const;
  /// The fan around a vertex, into one that is used again.
  void fan_around(int vertex, Fan& fan) const;

 private:
  const Surface& surface_;
  const Points& vertices_;
  const Triangles& triangles_;
};

}  // namespace palpation
