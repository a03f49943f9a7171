#include "io/landing.h"

#include <algorithm>

#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kDecimals =
    1.0 + 1e-9;  // a millimetre, written in decimals, may be a rounding more
constexpr double kFarthest_m = 0.005 * kDecimals;
constexpr double kUnremarkable_m = 0.0001;

std::string point_text(const Vec3& point) {
  return "(" + text_of(point.x()) + ", " + text_of(point.y()) + ", " + text_of(point.z()) + ") m";
}

}  // namespace

Landing::Landing(const Surface& surface, double farthest_beside_m)
    : surface_(surface),
      farthest_beside_m_(farthest_beside_m),
      least_(surface.mesh().vertices.colwise().minCoeff()),
      most_(surface.mesh().vertices.colwise().maxCoeff()),
      on_border_(static_cast<std::size_t>(surface.vertex_count()), false) {
  for (const std::vector<int>& loop : surface.border_loops()) {
    for (const int vertex : loop) on_border_[static_cast<std::size_t>(vertex)] = true;
  }
}

std::optional<SurfacePoint> Landing::place(const Vec3& position, std::string& fault) {
  fault.clear();
  const std::string start = "the position " + point_text(position) + " is ";
  const auto beyond_box = [&](const Vec3& point) {
    return Vec3((least_ - point).cwiseMax(point - most_).cwiseMax(0.0));
  };
  // Before the search for the closest point, whose squares must not overflow.
  if (const Vec3 beyond = beyond_box(position); beyond.maxCoeff() > kFarthest_m) {
    const bool seems_millimetres = (beyond.array() > kFarthest_m).count() > 1 &&
                                   beyond_box(position / 1000.0).maxCoeff() <= kFarthest_m;
    fault = start + text_of(beyond.maxCoeff()) +
            " m or more from the surface; at most 0.005 m is allowed" +
            (seems_millimetres ? " (is it in millimetres? positions are metres)" : "");
    return std::nullopt;
  }
  const SurfacePoint place = surface_.project(position);
  const double distance = (surface_.position(place) - position).norm();
  const double beside = beside_m(position, place);
  if (distance > kFarthest_m)
    fault = start + text_of(distance) + " m from the surface; at most 0.005 m is allowed";
  if (fault.empty() && beside > farthest_beside_m_ * kDecimals)
    fault = start + text_of(beside) + " m beside the border of the surface; at most " +
            text_of(farthest_beside_m_) + " m is allowed";
  if (!fault.empty()) return std::nullopt;
  farthest_m_ = std::max(farthest_m_, distance);
  if (distance > kUnremarkable_m) ++moved_;
  return place;
}

/// How far beside the tissue a point lies, apart from its height over the surface.
double Landing::beside_m(const Vec3& position, const SurfacePoint& closest) const {
  if (!is_on_border(closest)) return 0.0;
  const Vec3 offset = position - surface_.position(closest);
  const Vec3 normal = surface_.normal(closest);
  return (offset - normal.dot(offset) * normal).norm();
}

bool Landing::is_on_border(const SurfacePoint& point) const {
  for (int i = 0; i < 3; ++i) {
    if (point.barycentric[(i + 2) % 3] == 0.0 && surface_.neighbour(point.face, i) < 0) return true;
    if (point.barycentric[i] == 1.0 &&
        on_border_[static_cast<std::size_t>(surface_.triangle(point.face)[i])])
      return true;
  }
  return false;
}

}  // namespace palpation
