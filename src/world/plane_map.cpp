#include "world/plane_map.h"

#include <Eigen/Geometry>

namespace palpation {
namespace {

/// The vertex with the greatest score, the lowest of equals.
template <typename Score>
int greatest(const Surface& surface, const Score& score) {
  int best = 0;
  for (int vertex = 1; vertex < surface.vertex_count(); ++vertex) {
    if (score(surface.vertex(vertex)) > score(surface.vertex(best))) best = vertex;
  }
  return best;
}

}  // namespace

// Three vertices that are far apart carry the frame, so that it is as exact as the vertices are,
// whatever the triangles look like.
PlaneMap::PlaneMap(const Surface& surface) {
  const Points2& uv = surface.chart().uv;
  origin_ = surface.vertex(0);
  origin_uv_ = uv.row(0);
  const int far = greatest(surface, [&](const Vec3& p) { return (p - origin_).squaredNorm(); });
  u_ = (surface.vertex(far) - origin_).normalized();
  axis_u_ = (uv.row(far).transpose() - origin_uv_).normalized();
  const int aside =
      greatest(surface, [&](const Vec3& p) { return u_.cross(p - origin_).squaredNorm(); });
  const Vec3 across = surface.vertex(aside) - origin_;
  const Vec2 across_uv = uv.row(aside).transpose() - origin_uv_;
  v_ = (across - u_.dot(across) * u_).normalized();
  axis_v_ = (across_uv - axis_u_.dot(across_uv) * axis_u_).normalized();
  normal_ = u_.cross(v_);
}

}  // namespace palpation
