#include "boundary/outline_length.h"

namespace palpation {

double piece_length(const Surface& surface, const LevelLoop& loop, std::size_t i) {
  if (loop.on_border[i]) return 0.0;
  const SurfacePoint& next = loop.points[(i + 1) % loop.points.size()];
  return (surface.position(next) - surface.position(loop.points[i])).norm();
}

double outline_length(const Surface& surface, const std::vector<LevelLoop>& loops) {
  double length = 0.0;
  for (const LevelLoop& loop : loops) {
    for (std::size_t i = 0; i < loop.points.size(); ++i) length += piece_length(surface, loop, i);
  }
  return length;
}

}  // namespace palpation
