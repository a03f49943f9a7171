#include "certainty/boundary_nodes.h"

#include "palpation/boundary/level_set.h"

namespace palpation {
namespace {

constexpr double kSpacing_m = 0.0008;

}  // namespace

BoundaryNodes boundary_nodes(const Surface& surface, const Field& depth) {
  BoundaryNodes nodes;
  for (const LevelLoop& loop : level_loops(surface, depth, 0.0)) {
    double run = 0.0;
    bool follows = false;
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      if (loop.on_border[i]) {
        follows = false;
        continue;
      }
      const SurfacePoint& next = loop.points[(i + 1) % loop.points.size()];
      run += (surface.position(next) - surface.position(loop.points[i])).norm();
      if (run < kSpacing_m && i + 1 < loop.points.size()) continue;
      nodes.points.push_back(next);
      nodes.length_m.push_back(run);
      nodes.follows_last.push_back(follows);
      follows = true;
      run = 0.0;
    }
  }
  return nodes;
}

}  // namespace palpation
