#include "palpation/exploration/reach.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "palpation/base/error.h"
#include "palpation/geometry/clearance.h"

namespace palpation {

std::vector<int> reachable_vertices(const Surface& surface, const Access& access) {
  require(access.cone_rad > 0.0 && access.cone_rad <= std::numbers::pi, "Access",
          "cone_rad = " + text_of(access.cone_rad), "must lie in (0, pi]");
  require(std::isfinite(access.clearance_m) && access.clearance_m >= 0.0, "Access",
          "clearance_m = " + text_of(access.clearance_m), "must be finite and not negative");
  require(std::isfinite(access.probe_radius_m) && access.probe_radius_m >= 0.0, "Access",
          "probe_radius_m = " + text_of(access.probe_radius_m), "must be finite and not negative");
  std::vector<bool> is_clear;
  if (access.clearance_m > 0.0)
    is_clear = clear_vertices(surface, access.clearance_m, access.probe_radius_m);
  Vec3 shaft = Vec3::Zero();
  if (access.shaft_direction) {
    shaft = access.shaft_direction->stableNormalized();
    require(access.shaft_direction->allFinite() && shaft.norm() > 0.5, "Access", "shaft_direction",
            "must be finite and not zero");
  }
  std::vector<int> vertices;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    const Vec3 normal = surface.vertex_normals().row(vertex);
    const double angle = std::atan2(normal.cross(shaft).norm(), normal.dot(shaft));
    const bool faces_shaft = !access.shaft_direction || angle <= access.cone_rad;
    if (faces_shaft && (is_clear.empty() || is_clear[static_cast<std::size_t>(vertex)]))
      vertices.push_back(vertex);
  }
  return vertices;
}

}  // namespace palpation
