#include "certainty/layout.h"

#include "palpation/geometry/chart_place.h"

namespace palpation {

Layout::Layout(const Prior& prior)
    : surface_(prior.surface()),
      in_chart_(prior.metric() != Metric::Ambient && !surface_.is_planar() &&
                surface_.has_chart()) {}

Vec3 Layout::at(int vertex) const {
  if (!in_chart_) return surface_.vertex(vertex);
  const Points2& uv = surface_.chart().uv;
  return {uv(vertex, 0), uv(vertex, 1), 0.0};
}

Vec3 Layout::at(const SurfacePoint& point) const {
  if (!in_chart_) return surface_.position(point);
  const Vec2 uv = chart_place(surface_, point);
  return {uv.x(), uv.y(), 0.0};
}

std::vector<Vec3> Layout::vertices() const {
  std::vector<Vec3> places;
  for (int vertex = 0; vertex < surface_.vertex_count(); ++vertex) places.push_back(at(vertex));
  return places;
}

std::vector<Vec3> Layout::touched(std::span<const Palpation> palpations) const {
  std::vector<Vec3> places;
  for (const Palpation& palpation : palpations) {
    if (palpation.set_aside.empty()) places.push_back(at(palpation.where));
  }
  return places;
}

}  // namespace palpation
