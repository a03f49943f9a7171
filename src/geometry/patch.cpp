#include "palpation/geometry/patch.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "geometry/cut_out.h"
#include "palpation/base/error.h"
#include "palpation/geometry/distance.h"

namespace palpation {
namespace {

/// Whether a face comes within the radius in a straight line. Paths along the surface are longer, so all those of the radius' length stay
/// in such faces.
std::vector<bool> faces_in_ball(const Surface& surface, const Vec3& middle, double radius_m) {
  constexpr double kMargin = 1e-9;  // rounding must not cut off a path
  std::vector<bool> inside(surface.face_count());
  for (int f = 0; f < surface.face_count(); ++f) {
    const Eigen::Vector3i t = surface.triangle(f);
    const Vec3 centre = (surface.vertex(t[0]) + surface.vertex(t[1]) + surface.vertex(t[2])) / 3.0;
    double reach = 0.0;
    for (int i = 0; i < 3; ++i) reach = std::max(reach, (surface.vertex(t[i]) - centre).norm());
    inside[f] = (centre - middle).norm() <= (radius_m + reach) * (1.0 + kMargin);
  }
  return inside;
}

/// Whether the corners that carry the point belong to the face as well.
bool contains(const Surface& surface, int face, const SurfacePoint& point) {
  const Eigen::Vector3i corners = surface.triangle(face), carriers = surface.triangle(point.face);
  for (int i = 0; i < 3; ++i) {
    if (point.barycentric[i] > 0.0 && (corners.array() != carriers[i]).all()) return false;
  }
  return true;
}

TriangleMesh patch_by_distance(const Surface& surface, const SurfacePoint& middle, double radius_m) {
  const Field distance = distance_from(surface, std::span(&middle, 1));
  std::vector<bool> keep(surface.face_count());
  int seed = -1;
  for (int f = 0; f < surface.face_count(); ++f) {
    const Eigen::Vector3i t = surface.triangle(f);
    keep[f] = std::max({distance[t[0]], distance[t[1]], distance[t[2]]}) <= radius_m;
    if (keep[f] && seed < 0 && contains(surface, f, middle)) seed = f;
  }
  require(seed >= 0, "patch_around", "radius_m " + text_of(radius_m),
          "must be large enough for a triangle around the centre: take a larger one, or refine");
  return cut_out(surface, keep, seed).mesh;
}

}  // namespace

TriangleMesh patch_around(const Surface& surface, const Vec3& centre, double radius_m) {
  require(std::isfinite(radius_m) && radius_m > 0.0, "patch_around", "radius_m " + text_of(radius_m), "must be positive and finite");
  const SurfacePoint middle = surface.project(centre);
  if (surface.is_planar()) return patch_by_distance(surface, middle, radius_m);
  surface.note_computed("geodesics");
  const CutOut ball = cut_out(surface, faces_in_ball(surface, surface.position(middle), radius_m), middle.face);
  const auto face = std::lower_bound(ball.faces.begin(), ball.faces.end(), middle.face) - ball.faces.begin();
  return patch_by_distance(Surface(ball.mesh), {static_cast<int>(face), middle.barycentric}, radius_m);
}

}  // namespace palpation
