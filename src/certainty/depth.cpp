#include "certainty/depth.h"

#include "geometry/nearest_segment.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

constexpr int kPlacesAtOnce = 512;

std::vector<Segment<3>> pieces_of(const Layout& layout, std::span<const LevelLoop> loops) {
  std::vector<Segment<3>> pieces;
  for (const LevelLoop& loop : loops) {
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      if (loop.on_border[i]) continue;
      pieces.push_back(
          {layout.at(loop.points[i]), layout.at(loop.points[(i + 1) % loop.points.size()])});
    }
  }
  return pieces;
}

}  // namespace

std::vector<double> distances_from(const Layout& layout, std::span<const LevelLoop> loops,
                                   std::span<const Vec3> places) {
  std::vector<Segment<3>> pieces = pieces_of(layout, loops);
  if (pieces.empty()) return {};
  const NearestSegment<3> nearest(std::move(pieces));
  std::vector<double> distances(places.size());
  for_ranges(static_cast<int>(places.size()), kPlacesAtOnce, [&](int first, int last) {
    int hint = 0;
    for (int i = first; i < last; ++i) distances[i] = nearest.distance(places[i], hint);
  });
  return distances;
}

}  // namespace palpation
