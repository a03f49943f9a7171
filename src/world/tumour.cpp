#include "palpation/world/tumour.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>

#include "palpation/base/error.h"
#include "palpation/base/parallel.h"
#include "palpation/geometry/distance.h"
#include "palpation/geometry/path.h"
#include "world/closed_lines.h"
#include "world/plane_map.h"

namespace palpation {
namespace {

constexpr double kFarthestCentre_m = 0.005;
constexpr double kStep = 0.028;             // along a horseshoe's arc, in half widths
constexpr double kMostSteps = 20'000;       // what an arc of 560 half widths takes
constexpr int kMostOutlinePoints = 10'000;  // each is compared with each

/// A tumour's place in the list, for messages.
struct Name {
  std::string text;
  void require(bool condition, const std::string& value, const std::string& rule) const {
    palpation::require(condition, "signed_distance", text + ": " + value, rule);
  }
  void require_length(const std::string& what, double length_m) const {
    require(std::isfinite(length_m) && length_m > 0.0, what + " " + text_of(length_m) + " m",
            "must be positive and finite");
  }
  void require_close(const Vec3& position, double distance_m) const {
    const std::string place = "(" + text_of(position.x()) + ", " + text_of(position.y()) + ", " +
                              text_of(position.z()) + ") m";
    require(distance_m <= kFarthestCentre_m,
            place + ", " + text_of(distance_m) + " m from the surface,",
            "must be within 0.005 m of it");
  }
};

void check_point(const Vec3& position, const Name& name) {
  name.require(position.allFinite(), "a coordinate", "must be finite");
}

void check(const Disk& disk, const Name& name) {
  check_point(disk.centre_m, name);
  name.require_length("radius", disk.radius_m);
}

void check(const Horseshoe& horseshoe, const Name& name) {
  check_point(horseshoe.centre_m, name);
  name.require_length("arc radius", horseshoe.arc_radius_m);
  name.require_length("half width", horseshoe.half_width_m);
  name.require(horseshoe.half_width_m < horseshoe.arc_radius_m,
               "half width " + text_of(horseshoe.half_width_m) + " m",
               "must be below the arc radius " + text_of(horseshoe.arc_radius_m) + " m");
  name.require(horseshoe.arc_rad > 0.0 && horseshoe.arc_rad <= 2.0 * std::numbers::pi,
               "arc " + text_of(horseshoe.arc_rad) + " rad", "must be positive and at most 2 pi");
  name.require(horseshoe.facing.allFinite(), "facing", "must be finite");
}

void check(const Outline& outline, const Name& name) {
  const std::size_t count = outline.points_m.size();
  name.require(count <= kMostOutlinePoints, "an outline of " + std::to_string(count) + " points",
               "must have at most " + std::to_string(kMostOutlinePoints));
  for (const Vec3& point : outline.points_m) check_point(point, name);
}

/// The direction in the tissue that a vector shows, where it shows one: it does not when it is
/// (almost) along the normal.
template <typename Vector>
Vector direction_of(const Vector& tangential, double length, const Name& name) {
  name.require(tangential.norm() > 1e-6 * length, "facing", "must have a part along the surface");
  return tangential.normalized();
}

/// Planar tissue: shapes live in its plane, where all distances are straight.
class FlatTissue {
 public:
  explicit FlatTissue(const Surface& surface)
      : surface_(surface), map_(surface), border_(border_lines(surface)) {}

  Vec2 place(const Vec3& position, const Name& name) const {
    const Vec2 uv = map_.place(position);
    name.require_close(
        position, std::hypot(map_.height(position), std::max(0.0, -border_.signed_distance(uv))));
    return uv;
  }

  Vec2 direction(const Vec3& vector) const { return map_.direction(vector); }

  template <typename Distance>
  Field at_vertices(const Distance& distance) const {
    const Points2& uv = surface_.chart().uv;
    Field field(surface_.vertex_count());
    for_ranges(surface_.vertex_count(), 1024, [&](int first, int last) {
      for (int vertex = first; vertex < last; ++vertex)
        field[vertex] = distance(uv.row(vertex).transpose());
    });
    return field;
  }

 private:
  static std::vector<std::vector<Vec2>> border_lines(const Surface& surface) {
    std::vector<std::vector<Vec2>> lines;
    for (const std::vector<int>& loop : surface.border_loops()) {
      std::vector<Vec2>& line = lines.emplace_back();
      for (int vertex : loop) line.emplace_back(surface.chart().uv.row(vertex));
    }
    return lines;
  }

  const Surface& surface_;
  PlaneMap map_;
  ClosedLines border_;
};

Field distance_inside(const FlatTissue& tissue, const Disk& disk, const Name& name) {
  const Vec2 centre = tissue.place(disk.centre_m, name);
  return tissue.at_vertices(
      [&](const Vec2& place) { return disk.radius_m - (place - centre).norm(); });
}

/// From a place in the frame of an arc (its centre at the origin, its middle on the x axis) to the
/// arc.
double distance_to_arc(const Vec2& place, double radius_m, double half_angle) {
  const Vec2 mirrored(place.x(), std::abs(place.y()));
  if (std::atan2(mirrored.y(), mirrored.x()) <= half_angle)
    return std::abs(mirrored.norm() - radius_m);
  return (mirrored - radius_m * Vec2(std::cos(half_angle), std::sin(half_angle))).norm();
}

Field distance_inside(const FlatTissue& tissue, const Horseshoe& horseshoe, const Name& name) {
  const Vec2 centre = tissue.place(horseshoe.centre_m, name);
  const Vec2 x = direction_of(tissue.direction(horseshoe.facing), horseshoe.facing.norm(), name);
  const Vec2 y(-x.y(), x.x());
  return tissue.at_vertices([&](const Vec2& place) {
    const Vec2 arm = place - centre;
    return horseshoe.half_width_m - distance_to_arc(Vec2(x.dot(arm), y.dot(arm)),
                                                    horseshoe.arc_radius_m,
                                                    0.5 * horseshoe.arc_rad);
  });
}

std::vector<Vec2> without_repeats(const std::vector<Vec2>& points) {
  std::vector<Vec2> line;
  for (const Vec2& point : points) {
    if (line.empty() || point != line.back()) line.push_back(point);
  }
  while (line.size() > 1 && line.back() == line.front()) line.pop_back();
  return line;
}

void require_simple(const std::vector<Vec2>& line, const std::vector<int>& side_of,
                    const Name& name) {
  const auto sides = sides_that_meet(line);
  if (!sides) return;
  const std::string both =
      std::to_string(side_of[sides->first]) + " and " + std::to_string(side_of[sides->second]);
  name.require(false, "an outline whose sides " + both + " meet", "must not cross or touch itself");
}

void require_corners(std::size_t count, const Name& name) {
  name.require(count >= 3, "an outline of " + std::to_string(count) + " distinct points",
               "must have at least three");
}

Field distance_inside(const FlatTissue& tissue, const Outline& outline, const Name& name) {
  std::vector<Vec2> points;
  for (const Vec3& point : outline.points_m) points.push_back(snapped(tissue.place(point, name)));
  const std::vector<Vec2> line = without_repeats(points);
  require_corners(line.size(), name);
  std::vector<int> side_of(line.size());
  std::iota(side_of.begin(), side_of.end(), 1);
  require_simple(line, side_of, name);
  const ClosedLines closed({line});
  return tissue.at_vertices([&](const Vec2& place) { return closed.signed_distance(place); });
}

/// A point that is beside a corner or an edge by rounding only is put on it: exact unfolding of
/// faces does not survive sources there.
SurfacePoint cleaned(SurfacePoint point) {
  point.barycentric = (point.barycentric.array() < 1e-9).select(0.0, point.barycentric);
  point.barycentric /= point.barycentric.sum();
  return point;
}

SurfacePoint centre_on(const Surface& surface, const Vec3& position, const Name& name) {
  const SurfacePoint centre = cleaned(surface.project(position));
  name.require_close(position, (position - surface.position(centre)).norm());
  return centre;
}

Field distance_inside(const Surface& surface, const Disk& disk, const Name& name) {
  const std::vector<SurfacePoint> centre = {centre_on(surface, disk.centre_m, name)};
  return disk.radius_m - distance_from(surface, centre).array();
}

/// An arc in the tangent plane at the centre, taken down to the surface, in steps so short that at
/// the outline, a half width away, the distance to the nearest step is that to the arc to a
/// ten-thousandth: sqrt(1 + (step / 2)^2) - 1 < 1e-4 in half widths.
std::vector<SurfacePoint> arc_on(const Surface& surface, const Horseshoe& horseshoe,
                                 const SurfacePoint& centre, const Name& name) {
  const Vec3 normal = surface.normal(centre);
  const Vec3 tangential = horseshoe.facing - normal.dot(horseshoe.facing) * normal;
  const Vec3 x = direction_of(tangential, horseshoe.facing.norm(), name);
  const Vec3 y = normal.cross(x);
  const double steps = std::min(kMostSteps, std::ceil(horseshoe.arc_radius_m * horseshoe.arc_rad /
                                                      (kStep * horseshoe.half_width_m)));
  std::vector<SurfacePoint> arc;
  for (double step = 0.0; step <= steps; step += 1.0) {
    const double angle = horseshoe.arc_rad * (step / steps - 0.5);
    const Vec3 place = surface.position(centre) +
                       horseshoe.arc_radius_m * (std::cos(angle) * x + std::sin(angle) * y);
    arc.push_back(cleaned(surface.project(place)));
  }
  return arc;
}

Field distance_inside(const Surface& surface, const Horseshoe& horseshoe, const Name& name) {
  name.require(horseshoe.arc_radius_m <= surface.diameter(),
               "arc radius " + text_of(horseshoe.arc_radius_m) + " m",
               "must not exceed the tissue's size, " + text_of(surface.diameter()) + " m");
  const SurfacePoint centre = centre_on(surface, horseshoe.centre_m, name);
  return horseshoe.half_width_m -
         distance_from(surface, arc_on(surface, horseshoe, centre, name)).array();
}

std::vector<SurfacePoint> corners_on(const Surface& surface, const Outline& outline,
                                     const Name& name) {
  std::vector<SurfacePoint> corners;
  const auto are_one = [&](const SurfacePoint& a, const SurfacePoint& b) {
    return snapped_place(surface, a) == snapped_place(surface, b);
  };
  for (const Vec3& point : outline.points_m) {
    const SurfacePoint corner = centre_on(surface, point, name);
    if (corners.empty() || !are_one(corner, corners.back())) corners.push_back(corner);
  }
  while (corners.size() > 1 && are_one(corners.back(), corners.front())) corners.pop_back();
  return corners;
}

/// Sides are shortest ways over the tissue; where they run, and distances from them, are told in
/// its chart.
Field distance_inside(const Surface& surface, const Outline& outline, const Name& name) {
  name.require(surface.has_chart(), "an outline",
               "needs tissue that can be laid flat: a patch without holes");
  const std::vector<SurfacePoint> corners = corners_on(surface, outline, name);
  require_corners(corners.size(), name);
  const double step_m =
      std::sqrt(surface.area() / surface.face_count());  // about two thirds of an edge
  std::vector<Vec2> line;
  std::vector<int> side_of;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const SurfacePoint& next = corners[(i + 1) % corners.size()];
    std::vector<SurfacePoint> side = way_between(surface, corners[i], next, step_m);
    side.insert(side.begin(), corners[i]);
    for (const SurfacePoint& place : side) {
      line.push_back(snapped_place(surface, place));
      side_of.push_back(static_cast<int>(i) + 1);
    }
  }
  require_simple(line, side_of, name);
  const ClosedLines closed({line});
  Field field(surface.vertex_count());
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    field[vertex] = closed.signed_distance(surface.chart().uv.row(vertex).transpose());
  }
  return field;
}

}  // namespace

Field signed_distance(const Surface& surface, std::span<const Tumour> tumours) {
  Field greatest =
      Field::Constant(surface.vertex_count(), -std::numeric_limits<double>::infinity());
  std::optional<FlatTissue> flat;
  if (!tumours.empty() && surface.is_planar()) flat.emplace(surface);
  for (std::size_t number = 0; number < tumours.size(); ++number) {
    const Name name{"tumour " + std::to_string(number + 1)};
    const Field distance = std::visit(
        [&](const auto& shape) {
          check(shape, name);
          return flat ? distance_inside(*flat, shape, name) : distance_inside(surface, shape, name);
        },
        tumours[number]);
    greatest = greatest.cwiseMax(distance);
  }
  return greatest;
}

}  // namespace palpation
