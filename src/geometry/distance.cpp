#include "palpation/geometry/distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/marching.h"
#include "geometry/unfolding.h"
#include "palpation/base/error.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

double turn(const Vec2& before, const Vec2& after) {
  return std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
}

/// A flat disk whose border turns left everywhere, once around: any two of its points see each
/// other.
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
    least =
        least.cwiseMin((surface.mesh().vertices.rowwise() - place.transpose()).rowwise().norm());
  }
  return least;
}

}  // namespace

Field distance_from(const Surface& surface, std::span<const SurfacePoint> sources,
                    double radius_m) {
  require(!sources.empty(), "distance_from", "0 sources", "must be at least one");
  require(radius_m > 0.0, "distance_from", "radius_m = " + text_of(radius_m), "must be positive");
  for (const SurfacePoint& source : sources)
    surface.position(source);  // throws where it is no point of the surface
  if (is_flat_and_convex(surface)) {
    const Field distances = straight_distances(surface, sources);
    return (distances.array() <= radius_m)
        .select(distances, std::numeric_limits<double>::infinity());
  }
  surface.note_computed("geodesics");
  return unfolded_distances(surface, sources, {.radius_m = radius_m});
}

Eigen::MatrixXd distances_between(const Surface& surface, std::span<const SurfacePoint> places) {
  const auto count = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd distances = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j)
      distances(i, j) = (surface.position(places[i]) - surface.position(places[j])).norm();
  }
  if (surface.is_planar()) return distances;
  surface.note_computed("surface distances");
  const Marching marching(surface);
  for_ranges(static_cast<int>(count), 1, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const std::vector<double> marched = marching.distances(places[i], places.subspan(i + 1));
      for (Eigen::Index j = i + 1; j < count; ++j)
        distances(i, j) = std::max(distances(i, j), marched[j - i - 1]);
    }
  });
  distances.triangularView<Eigen::StrictlyLower>() = distances.transpose();
  return distances;
}

std::vector<int> vertices_near(const Surface& surface, int vertex, double radius_m) {
  require(std::isfinite(radius_m) && radius_m >= 0.0, "vertices_near",
          "radius_m = " + text_of(radius_m), "must be finite and not negative");
  const Vec3 centre = surface.vertex(vertex);
  std::vector<int> near;
  for (int other = 0; other < surface.vertex_count(); ++other) {
    if ((surface.vertex(other) - centre).norm() < radius_m) near.push_back(other);
  }
  if (near.size() <= 1 || surface.is_planar()) return near;
  const SurfacePoint source = surface.at_vertex(vertex);
  const std::vector<double> distances = unfolded_distances_of(surface, source, near, radius_m);
  std::vector<int> result;
  for (std::size_t k = 0; k < near.size(); ++k) {
    if (distances[k] < radius_m) result.push_back(near[k]);
  }
  return result;
}

}  // namespace palpation
