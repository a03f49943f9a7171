#include "geometry/settled_point.h"

#include <cmath>

namespace palpation {
namespace {

constexpr double kSteps = 1073741824.0;  // 2^30: what a projection leaves of a weight is less

/// On the edge from corner `first` to the next one of its face; `across` is the face beyond it.
SurfacePoint on_lower_face(const Surface& surface, const SurfacePoint& point, int first,
                           int across) {
  const Eigen::Vector3i here = surface.triangle(point.face), there = surface.triangle(across);
  SurfacePoint moved{across, Vec3::Zero()};
  for (const int corner : {first, (first + 1) % 3}) {
    for (int other = 0; other < 3; ++other) {
      if (there[other] == here[corner]) moved.barycentric[other] = point.barycentric[corner];
    }
  }
  return moved;
}

}  // namespace

SurfacePoint settled_point(const Surface& surface, const SurfacePoint& point) {
  SurfacePoint settled = point;
  settled.barycentric = point.barycentric.unaryExpr(
      [](double weight) { return std::round(weight * kSteps) / kSteps; });
  Eigen::Index greatest = 0;
  settled.barycentric.maxCoeff(&greatest);
  settled.barycentric[greatest] = 0.0;
  settled.barycentric[greatest] = 1.0 - settled.barycentric.sum();
  if (const int vertex = surface.vertex_at(settled); vertex >= 0) return surface.at_vertex(vertex);
  for (int corner = 0; corner < 3; ++corner) {
    const int across = surface.neighbour(settled.face, corner);
    if (settled.barycentric[(corner + 2) % 3] == 0.0 && across >= 0 && across < settled.face)
      return on_lower_face(surface, settled, corner, across);
  }
  return settled;
}

}  // namespace palpation
