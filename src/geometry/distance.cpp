#include "palpation/geometry/distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/geodesics.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

double turn(const Vec2& before, const Vec2& after) {
  return std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
}

/// A flat disk whose border turns left everywhere, once around: any two of its points see each other.
bool is_flat_and_convex(const Surface& surface) {
  if (!surface.is_planar() || !surface.topology().is_disk()) return false;
  const Points2& uv = surface.chart().uv;
  const std::vector<int>& border = surface.border_loops().front();
  const std::size_t count = border.size();
  constexpr double kStraight = 1e-9;  // radians: rounding of corners on a straight side
  double whole_turn = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec2 before = uv.row(border[(k + 1) % count]) - uv.row(border[k]);
    const Vec2 after = uv.row(border[(k + 2) % count]) - uv.row(border[(k + 1) % count]);
    const double angle = turn(before, after);
    if (angle < -kStraight) return false;
    whole_turn += angle;
  }
  return std::abs(whole_turn - 2.0 * std::numbers::pi) < 1.0;
}

Field straight_distances(const Surface& surface, std::span<const SurfacePoint> sources) {
  Field least = Field::Constant(surface.vertex_count(), std::numeric_limits<double>::infinity());
  for (const SurfacePoint& source : sources) {
    const Vec3 place = surface.position(source);
    least = least.cwiseMin((surface.mesh().vertices.rowwise() - place.transpose()).rowwise().norm());
  }
  return least;
}

}  // namespace

Field distance_from(const Surface& surface, std::span<const SurfacePoint> sources) {
  require(!sources.empty(), "distance_from", "0 sources", "must be at least one");
  for (const SurfacePoint& source : sources) surface.position(source);  // throws where it is no point of the surface
  if (is_flat_and_convex(surface)) return straight_distances(surface, sources);
  surface.note_computed("geodesics");
  return unfold_distances(surface.mesh(), sources);
}

}  // namespace palpation
