#include "palpation/boundary/level_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/careful_sum.h"
#include "boundary/above_level.h"
#include "boundary/level_walk.h"
#include "boundary/reproducer.h"
#include "boundary/simple_loops.h"
#include "boundary/tissue_area.h"
#include "palpation/base/error.h"
#include "palpation/geometry/chart_place.h"

namespace palpation {

namespace {

double length(const Surface& surface, const LevelLoop& loop) {
  double sum = 0.0;
  Vec3 last = surface.position(loop.points.back());
  for (const SurfacePoint& point : loop.points) {
    const Vec3 here = surface.position(point);
    sum += (here - last).norm();
    last = here;
  }
  return sum;
}

LevelLoop level_loop(const ClosedWalk& steps) {
  LevelLoop loop;
  for (const Step& step : steps) {
    loop.points.push_back(step.point);
    loop.on_border.push_back(step.on_border);
  }
  return loop;
}

void sort_by_length(const Surface& surface, std::vector<LevelLoop>& loops) {
  std::vector<std::pair<double, int>> order;
  for (std::size_t i = 0; i < loops.size(); ++i)
    order.emplace_back(length(surface, loops[i]), static_cast<int>(i));
  std::sort(order.begin(), order.end(), [&](const auto& a, const auto& b) {
    if (a.first != b.first) return a.first > b.first;
    const int face_a = loops[a.second].points.front().face;
    const int face_b = loops[b.second].points.front().face;
    return face_a != face_b ? face_a < face_b : a.second < b.second;
  });
  std::vector<LevelLoop> sorted;
  for (const auto& [of_length, i] : order) sorted.push_back(std::move(loops[i]));
  loops = std::move(sorted);
}

/// How much of a triangle is inside, by the values at its corners less the level. Seen from its
/// apex, a corner alone on its side, each edge is cut at v / (v - w), and the tip cut off has the
/// product of the two as its share.
double share_inside(const Vec3& above) {
  const std::array<bool, 3> inside{above[0] >= 0.0, above[1] >= 0.0, above[2] >= 0.0};
  if (inside[0] == inside[1] && inside[1] == inside[2]) return inside[0] ? 1.0 : 0.0;
  const int apex = inside[1] == inside[2] ? 0 : (inside[0] == inside[2] ? 1 : 2);
  const double tip_height = above[apex];
  const double tip_share = tip_height / (tip_height - above[(apex + 1) % 3]) *
                           (tip_height / (tip_height - above[(apex + 2) % 3]));
  return inside[apex] ? tip_share : 1.0 - tip_share;
}

/// Of the faces' shares inside, times what `area_of_face` says.
template <typename AreaOfFace>
double sum_inside(const Surface& surface, const Field& field, double level,
                  AreaOfFace area_of_face) {
  const Triangles& triangles = surface.mesh().triangles;
  CarefulSum sum;
  for (int face = 0; face < triangles.rows(); ++face) {
    const int inside = (field[triangles(face, 0)] >= level) + (field[triangles(face, 1)] >= level) +
                       (field[triangles(face, 2)] >= level);
    if (inside == 0) continue;
    const double share = inside == 3 ? 1.0 : share_inside(above_level(surface, field, level, face));
    sum.add(share * area_of_face(face));
  }
  return sum.value();
}

/// Rounding may move each corner of the rings by some of its last places, and each triangle's area
/// by some of its edges' products.
void require_area_of_triangles(const Surface& surface, const Field& field, double level,
                               const std::vector<Ring>& rings, double area) {
  const Points2& uv = surface.chart().uv;
  double products = 0.0;
  const double expected = sum_inside(surface, field, level, [&](int face) {
    const Eigen::Vector3i t = surface.triangle(face);
    const Vec2 a = uv.row(t[1]) - uv.row(t[0]);
    const Vec2 b = uv.row(t[2]) - uv.row(t[0]);
    products += a.norm() * b.norm();
    return 0.5 * (a.x() * b.y() - a.y() * b.x());
  });
  double length = 0.0;
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      length += (ring[i] - ring[i > 0 ? i - 1 : ring.size() - 1]).norm();
  }
  const double tolerance = 16.0 * std::numeric_limits<double>::epsilon() *
                           (products + uv.cwiseAbs().maxCoeff() * length);
  if (std::abs(area - expected) <= tolerance) return;
  throw NumericalError("superlevel_region: the region's area " + text_of(area) +
                       " m2 contradicts its triangles, which give " + text_of(expected) +
                       " m2, for " + well_known_text(rings));
}

}  // namespace

std::vector<LevelLoop> level_loops(const Surface& surface, const Field& field, double level) {
  require_field(surface, field, level, "level_loops");
  std::vector<LevelLoop> loops;
  for (const ClosedWalk& loop : simple_loops(walks_around(surface, field, level)))
    loops.push_back(level_loop(loop));
  sort_by_length(surface, loops);
  return loops;
}

Region superlevel_region(const Surface& surface, const Field& field, double level) {
  std::vector<Ring> rings;
  for (const LevelLoop& loop : level_loops(surface, field, level)) {
    Ring& ring = rings.emplace_back();
    for (const SurfacePoint& point : loop.points) ring.push_back(chart_place(surface, point));
  }
  Region region = Region::even_odd(rings);
  require_area_of_triangles(surface, field, level, rings, region.area());
  return region;
}

double superlevel_area(const Surface& surface, const Field& field, double level) {
  require_field(surface, field, level, "superlevel_area");
  return sum_inside(surface, field, level, [&](int face) { return surface.face_area(face); });
}

double surface_area(const Surface& surface, const Region& region) {
  surface.chart();  // throws where there is none
  return surface.is_planar() ? region.area() : tissue_area(surface, region);
}

}  // namespace palpation
