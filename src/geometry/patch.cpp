#include "palpation/geometry/patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "geometry/cut_out.h"
#include "palpation/base/error.h"
#include "palpation/geometry/distance.h"

namespace palpation {
namespace {

/// Whether a face comes within the radius in a straight line. Paths along the surface are longer,
/// so all those of the radius' length stay in such faces.
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

TriangleMesh patch_by_distance(const Surface& surface, const SurfacePoint& middle,
                               double radius_m) {
  const Field distance = distance_from(surface, std::span(&middle, 1), radius_m);
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

void check(const PatchTests& tests) {
  if (tests.box) {
    const bool is_box = tests.box->least.allFinite() && tests.box->most.allFinite() &&
                        (tests.box->least.array() < tests.box->most.array()).all();
    require(is_box, "patch_passing", "box",
            "must be finite, its least corner below its greatest along every axis");
  }
  if (tests.facing) {
    const Vec3& direction = tests.facing->direction;
    require(direction.allFinite() && direction.norm() > 0.0, "patch_passing", "direction",
            "must be finite and not zero");
    require(tests.facing->within_rad > 0.0 && tests.facing->within_rad <= std::numbers::pi,
            "patch_passing", "within_rad " + text_of(tests.facing->within_rad),
            "must lie in (0, pi]");
  }
}

bool passes(const Surface& surface, const PatchTests& tests, int face) {
  if (tests.box) {
    for (const int vertex : surface.triangle(face)) {
      const Vec3 place = surface.vertex(vertex);
      if ((place.array() < tests.box->least.array()).any() ||
          (place.array() > tests.box->most.array()).any())
        return false;
    }
  }
  if (!tests.facing) return true;
  const Vec3 normal = surface.face_normal(face), direction = tests.facing->direction;
  return std::atan2(normal.cross(direction).norm(), normal.dot(direction)) <=
         tests.facing->within_rad;
}

Vec3 middle_of(const Surface& surface, int face) {
  const Eigen::Vector3i t = surface.triangle(face);
  return (surface.vertex(t[0]) + surface.vertex(t[1]) + surface.vertex(t[2])) / 3.0;
}

int nearest_of(const Surface& surface, const std::vector<bool>& keep, const Vec3& centre) {
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int face = 0; face < surface.face_count(); ++face) {
    if (!keep[face]) continue;
    const double distance = (middle_of(surface, face) - centre).norm();
    if (distance < least) {
      least = distance;
      nearest = face;
    }
  }
  return nearest;
}

/// A face of the component of the largest area, the lowest.
int seed_of_largest(const Surface& surface, const std::vector<bool>& keep) {
  std::vector<bool> seen(keep.size(), false);
  int seed = -1;
  double largest = 0.0;
  std::vector<int> stack;
  for (int first = 0; first < surface.face_count(); ++first) {
    if (!keep[first] || seen[first]) continue;
    double area = 0.0;
    stack = {first};
    seen[first] = true;
    while (!stack.empty()) {
      const int face = stack.back();
      stack.pop_back();
      area += surface.face_area(face);
      for (int corner = 0; corner < 3; ++corner) {
        const int next = surface.neighbour(face, corner);
        if (next < 0 || !keep[next] || seen[next]) continue;
        seen[next] = true;
        stack.push_back(next);
      }
    }
    if (area > largest) {
      largest = area;
      seed = first;
    }
  }
  return seed;
}

}  // namespace

TriangleMesh patch_around(const Surface& surface, const Vec3& centre, double radius_m) {
  require(std::isfinite(radius_m) && radius_m > 0.0, "patch_around",
          "radius_m " + text_of(radius_m), "must be positive and finite");
  const SurfacePoint middle = surface.project(centre);
  if (surface.is_planar()) return patch_by_distance(surface, middle, radius_m);
  surface.note_computed("geodesics");
  const CutOut ball =
      cut_out(surface, faces_in_ball(surface, surface.position(middle), radius_m), middle.face);
  const auto face =
      std::lower_bound(ball.faces.begin(), ball.faces.end(), middle.face) - ball.faces.begin();
  return patch_by_distance(Surface(ball.mesh), {static_cast<int>(face), middle.barycentric},
                           radius_m);
}

TriangleMesh patch_passing(const Surface& surface, const PatchTests& tests,
                           const std::optional<Vec3>& centre) {
  check(tests);
  std::vector<bool> keep(surface.face_count());
  for (int face = 0; face < surface.face_count(); ++face) keep[face] = passes(surface, tests, face);
  if (centre) require(centre->allFinite(), "patch_passing", "centre", "must be finite");
  const int seed = centre ? nearest_of(surface, keep, *centre) : seed_of_largest(surface, keep);
  require(seed >= 0, "patch_passing", "0 triangles", "pass: take a larger box or angle, or refine");
  return cut_out(surface, keep, seed).mesh;
}

}  // namespace palpation
