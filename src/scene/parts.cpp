#include "scene/parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/normal.h"
#include "palpation/boundary/level_set.h"

namespace palpation::tool {
namespace {

/// On flat tissue the chart's area is the tissue's.
double area_on_tissue(const PolygonWithHoles& polygon, double in_chart_m2, const Surface& surface) {
  if (surface.is_planar()) return in_chart_m2;
  std::vector<Ring> rings = polygon.holes;
  rings.push_back(polygon.outer);
  return surface_area(surface, Region::even_odd(rings));
}

TumourPart measured(const PolygonWithHoles& polygon, const Surface& surface) {
  TumourPart part{.polygon = polygon};
  double twice_area = 0.0;
  Vec2 moment = Vec2::Zero();
  const Vec2 origin = polygon.outer.front();
  part.least_m = part.most_m = origin;
  const auto add = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i] - origin;
      const Vec2 b = ring[(i + 1) % ring.size()] - origin;
      const double cross = a.x() * b.y() - a.y() * b.x();
      twice_area += cross;
      moment += cross * (a + b) / 3.0;
      part.least_m = part.least_m.cwiseMin(ring[i]);
      part.most_m = part.most_m.cwiseMax(ring[i]);
    }
  };
  add(polygon.outer);
  for (const Ring& hole : polygon.holes) add(hole);
  part.area_m2 = area_on_tissue(polygon, 0.5 * twice_area, surface);
  part.centroid_m = origin + moment / twice_area;
  Eigen::Index nearest = 0;
  (surface.chart().uv.rowwise() - part.centroid_m.transpose())
      .rowwise()
      .squaredNorm()
      .minCoeff(&nearest);
  part.position_m = surface.vertex(static_cast<int>(nearest));
  return part;
}

/// Every part of a level set holds a vertex, which is as deep as the part is; where rounding hides
/// it, the part is at the level.
void look_inside(TumourPart& part, const Surface& surface, const Field& score) {
  double deepest = 0.0;
  const auto is_inside = [&](int vertex) {
    const Vec2 place = surface.chart().uv.row(vertex).transpose();
    const bool near = (place.array() >= part.least_m.array()).all() &&
                      (place.array() <= part.most_m.array()).all();
    return near && contains(part.polygon, place);
  };
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    if (score[vertex] > deepest && is_inside(vertex)) deepest = score[vertex];
  }
  part.probability = normal_probability(deepest);
}

bool lies_on_border(const Vec2& place, const Surface& surface) {
  for (const std::vector<int>& loop : surface.border_loops()) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = surface.chart().uv.row(loop[i]).transpose();
      const Vec2 along = surface.chart().uv.row(loop[(i + 1) % loop.size()]).transpose() - a;
      const double share = std::clamp((place - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
      if ((place - a - share * along).norm() <= 1e-9 * surface.diameter()) return true;
    }
  }
  return false;
}

/// Where the outline follows the border it has corners there.
bool touches_border(const PolygonWithHoles& polygon, const Surface& surface) {
  return std::ranges::any_of(polygon.outer,
                             [&](const Vec2& place) { return lies_on_border(place, surface); });
}

/// Of the part of the belief whose summit lies within this one; nothing where one contrast explains
/// all.
std::optional<PartContrast> contrast_of(const TumourPart& part, const Surface& surface,
                                        const EdgeBelief& edge) {
  for (const PartContrast& one : edge.parts()) {
    const Vec2 summit = surface.chart().uv.row(surface.vertex_at(one.where)).transpose();
    if (contains(part.polygon, summit)) return one;
  }
  return std::nullopt;
}

}  // namespace

bool winds_around(const Ring& ring, const Vec2& place) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2& a = ring[i];
    const Vec2& b = ring[(i + 1) % ring.size()];
    if ((a.y() > place.y()) != (b.y() > place.y()) &&
        place.x() < a.x() + (place.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

bool contains(const PolygonWithHoles& polygon, const Vec2& place) {
  return winds_around(polygon.outer, place) &&
         std::ranges::none_of(polygon.holes,
                              [&](const Ring& hole) { return winds_around(hole, place); });
}

TumourPart measured(const Ring& ring, const Surface& surface) {
  return measured(PolygonWithHoles{ring, {}}, surface);
}

std::vector<TumourPart> parts_of(const Episode& episode) {
  std::vector<TumourPart> parts;
  const Exploration& exploration = episode.exploration;
  for (const PolygonWithHoles& polygon : episode.estimate.polygons()) {
    TumourPart& part = parts.emplace_back(measured(polygon, exploration.surface()));
    if (exploration.conclusion().certainty)
      look_inside(part, exploration.surface(), exploration.conclusion().certainty->score);
    part.touches_border = touches_border(polygon, exploration.surface());
    if (exploration.conclusion().edge)
      part.contrast = contrast_of(part, exploration.surface(), *exploration.conclusion().edge);
  }
  return parts;
}

}  // namespace palpation::tool
