#include "palpation/geometry/chart_place.h"

namespace palpation {

Vec2 chart_place(const Surface& surface, const SurfacePoint& point) {
  const Points2& uv = surface.chart().uv;
  const Eigen::Vector3i corners = surface.triangle(point.face);
  Vec2 place = Vec2::Zero();
  for (int i = 0; i < 3; ++i) place += point.barycentric[i] * uv.row(corners[i]).transpose();
  return place;
}

}  // namespace palpation
