#include "geometry/flatten.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/boundary_first.h"
#include "geometry/chart_frame.h"
#include "geometry/circle_map.h"
#include "geometry/conformal.h"
#include "geometry/flat_descent.h"
#include "geometry/overlap.h"
#include "geometry/unfold.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kIsometric = 1e-6;

double twice_area(const Triangles& triangles, Eigen::Index face, const Points2& uv) {
  const Vec2 ab = uv.row(triangles(face, 1)) - uv.row(triangles(face, 0)),
             ac = uv.row(triangles(face, 2)) - uv.row(triangles(face, 0));
  return ab.x() * ac.y() - ab.y() * ac.x();
}

double area_of(const Triangles& triangles, const Points2& uv) {
  double twice = 0.0;
  for (Eigen::Index face = 0; face < triangles.rows(); ++face)
    twice += twice_area(triangles, face, uv);
  return 0.5 * twice;
}

std::optional<Eigen::Index> first_turned(const Triangles& triangles, const Points2& uv) {
  for (Eigen::Index face = 0; face < triangles.rows(); ++face) {
    if (!(twice_area(triangles, face, uv) > 0.0)) return face;
  }
  return std::nullopt;
}

Points2 of_area(Points2 uv, const Triangles& triangles, double area) {
  return uv * std::sqrt(area / area_of(triangles, uv));
}

/// The mesh measures about 1. Three starts are tried for the best map, the one that is closest and
/// costs least first; only where each leads to triangles turned over, for a map that never turns
/// one.
Points2 flattened(const TriangleMesh& mesh, const std::vector<int>& border, double area) {
  if (const std::optional<Points2> start = boundary_first_map(mesh, border)) {
    Points2 rigid = descended(FlatEnergy::Rigid, mesh, of_area(*start, mesh.triangles, area));
    if (!first_turned(mesh.triangles, rigid)) return rigid;
  }
  const std::optional<Points2> conformal = conformal_map(mesh);
  const bool conformal_turns = !conformal || first_turned(mesh.triangles, *conformal);
  const Points2 start =
      of_area(conformal ? *conformal : circle_map(mesh, border), mesh.triangles, area);
  Points2 rigid = descended(FlatEnergy::Rigid, mesh, start);
  if (!first_turned(mesh.triangles, rigid)) return rigid;
  return descended(
      FlatEnergy::Barrier, mesh,
      conformal_turns ? of_area(circle_map(mesh, border), mesh.triangles, area) : start);
}

Distortion distortion_of(const TriangleMesh& mesh, const Points2& uv) {
  const std::vector<FlatTriangle> flat = flat_triangles(mesh);
  Distortion worst;
  double sum = 0.0, area = 0.0;
  for (Eigen::Index face = 0; face < mesh.triangles.rows(); ++face) {
    const Eigen::Matrix2d j = jacobian(flat[face], mesh.triangles, face, uv);
    // Singular values of a 2 x 2 matrix as sum and difference of its similarity parts.
    const double turning = 0.5 * std::hypot(j(0, 0) + j(1, 1), j(1, 0) - j(0, 1));
    const double mirroring = 0.5 * std::hypot(j(0, 0) - j(1, 1), j(1, 0) + j(0, 1));
    const double most = turning + mirroring, least = turning - mirroring;
    worst.least_stretch = std::min(worst.least_stretch, least);
    worst.greatest_stretch = std::max(worst.greatest_stretch, most);
    worst.least_area_ratio = std::min(worst.least_area_ratio, j.determinant());
    worst.greatest_area_ratio = std::max(worst.greatest_area_ratio, j.determinant());
    sum += flat[face].area * 0.5 * ((most - 1.0) * (most - 1.0) + (least - 1.0) * (least - 1.0));
    area += flat[face].area;
  }
  worst.rms_stretch_error = std::sqrt(sum / area);
  return worst;
}

std::string fault_of(const TriangleMesh& mesh, const Connectivity& connectivity,
                     const std::vector<std::vector<int>>& border_loops, const Points2& uv) {
  if (!uv.allFinite()) return "flattening it leads to no numbers";
  if (const auto face = first_turned(mesh.triangles, uv))
    return "laid flat, triangle " + std::to_string(*face) + " has no area";
  if (const auto place =
          place_of_overlap(mesh.triangles, connectivity.neighbours, border_loops, uv))
    return "laid flat, it lies over itself at u = " + text_of(place->x()) +
           " m, v = " + text_of(place->y()) + " m";
  return "";
}

}  // namespace

Flattened flatten(const TriangleMesh& mesh, const Connectivity& connectivity,
                  const std::vector<std::vector<int>>& border_loops, double area, double diameter) {
  // Of size 1 at the origin: what follows is then the same at any scale.
  TriangleMesh unit = mesh;
  unit.vertices = (mesh.vertices.rowwise() - mesh.vertices.row(0)) / diameter;
  const double unit_area = area / diameter / diameter;
  const std::optional<Points2> unfolded = unfold(unit, connectivity.neighbours);
  Points2 uv = unfolded ? *unfolded
                        : of_area(flattened(unit, border_loops.front(), unit_area), mesh.triangles,
                                  unit_area);
  uv = in_frame(unit, uv) * diameter;
  Flattened made;
  made.fault = fault_of(mesh, connectivity, border_loops, uv);
  if (!made.fault.empty()) return made;
  made.chart.uv = std::move(uv);
  made.chart.distortion = distortion_of(mesh, made.chart.uv);
  made.chart.isometric =
      unfolded.has_value() || (made.chart.distortion.greatest_stretch <= 1.0 + kIsometric &&
                               made.chart.distortion.least_stretch >= 1.0 - kIsometric);
  return made;
}

}  // namespace palpation
