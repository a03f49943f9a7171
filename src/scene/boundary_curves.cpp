#include "scene/boundary_curves.h"

#include <algorithm>
#include <numeric>

#include "palpation/boundary/level_set.h"
#include "scene/parts.h"

namespace palpation::tool {
namespace {

Ring chart_ring(const Surface& surface, const LevelLoop& loop) {
  const Points2& uv = surface.chart().uv;
  Ring ring;
  for (const SurfacePoint& point : loop.points) {
    Vec2 place = Vec2::Zero();
    for (int corner = 0; corner < 3; ++corner)
      place += point.barycentric[corner] * uv.row(surface.triangle(point.face)[corner]).transpose();
    ring.push_back(place);
  }
  return ring;
}

double signed_area(const Ring& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i] - ring[0];
    const Vec2 b = ring[(i + 1) % ring.size()] - ring[0];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

}  // namespace

std::vector<BoundaryCurve> boundary_curves(const Surface& surface, const Field& field, double level,
                                           CurveKind kind) {
  const std::vector<LevelLoop> loops = level_loops(surface, field, level);
  std::vector<Ring> rings;
  std::vector<double> areas;
  for (const LevelLoop& loop : loops) {
    rings.push_back(chart_ring(surface, loop));
    areas.push_back(signed_area(rings.back()));
  }
  std::vector<std::size_t> by_area(loops.size());
  std::iota(by_area.begin(), by_area.end(), std::size_t{0});
  std::stable_sort(by_area.begin(), by_area.end(),
                   [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });

  std::vector<BoundaryCurve> curves;
  std::vector<std::size_t> outers;  // by part
  for (std::size_t i : by_area) {
    BoundaryCurve curve;
    for (const SurfacePoint& point : loops[i].points)
      curve.points.push_back(surface.position(point));
    curve.kind = kind;
    curve.hole = areas[i] < 0.0;
    if (!curve.hole) {
      curve.part = static_cast<int>(outers.size());
      outers.push_back(i);
    } else {
      for (std::size_t part = 0; part < outers.size();
           ++part) {  // the last, smallest one that winds around it
        if (winds_around(rings[outers[part]], rings[i].front()))
          curve.part = static_cast<int>(part);
      }
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace palpation::tool
