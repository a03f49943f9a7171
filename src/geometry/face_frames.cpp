#include "geometry/face_frames.h"

#include <Eigen/Geometry>
#include <cmath>

namespace palpation {

EdgeFrame FaceFrames::frame(int half_edge) const {
  const Vec3 a = place(start(half_edge));
  const Vec3 along = place(end(half_edge)) - a, up = place(apex(half_edge)) - a;
  const double length = along.norm();
  return {length, Vec2(along.dot(up) / length, along.cross(up).norm() / length)};
}

Vec2 FaceFrames::in_frame(int half_edge, const EdgeFrame& frame, const Vec3& barycentric) const {
  const int corner = half_edge % 3;
  return barycentric[(corner + 1) % 3] * Vec2(frame.length, 0.0) +
         barycentric[(corner + 2) % 3] * frame.apex;
}

int FaceFrames::opposite(int half_edge) const {
  const int face = surface_.neighbour(half_edge / 3, half_edge % 3);
  if (face < 0) return -1;
  const int first = end(half_edge);
  for (int corner = 0; corner < 3; ++corner) {
    if (triangles_(face, corner) == first) return 3 * face + corner;
  }
  return -1;
}

void FaceFrames::fan_around(int vertex, Fan& fan) const {
  const auto corner_of = [&](int face) {
    return triangles_(face, 0) == vertex ? 0 : triangles_(face, 1) == vertex ? 1 : 2;
  };
  const int any = surface_.face_of_vertex(vertex);
  int first = any;
  for (int before = surface_.neighbour(first, corner_of(first)); before >= 0 && before != any;) {
    first = before;
    before = surface_.neighbour(first, corner_of(first));
  }
  if (surface_.neighbour(first, corner_of(first)) == any) first = any;
  fan.blades.clear();
  double start = 0.0;
  int face = first;
  do {
    const int corner = corner_of(face);
    const Vec3 next = place(triangles_(face, (corner + 1) % 3)) - place(vertex),
               last = place(triangles_(face, (corner + 2) % 3)) - place(vertex);
    const double angle = std::atan2(next.cross(last).norm(), next.dot(last));
    fan.blades.push_back({face, corner, start, angle});
    start += angle;
    face = surface_.neighbour(face, (corner + 2) % 3);
  } while (face >= 0 && face != first);
  fan.closes = face == first;
}

}  // namespace palpation
