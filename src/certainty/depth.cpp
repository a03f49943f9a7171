#include "certainty/depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpation {
namespace {

struct Piece {
  Vec3 from;
  Vec3 along;
};

std::vector<Piece> pieces_of(const Surface& surface, std::span<const LevelLoop> loops) {
  std::vector<Piece> pieces;
  for (const LevelLoop& loop : loops) {
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      if (loop.on_border[i]) continue;
      const Vec3 from = surface.position(loop.points[i]);
      pieces.push_back({from, surface.position(loop.points[(i + 1) % loop.points.size()]) - from});
    }
  }
  return pieces;
}

double squared_distance(const Piece& piece, const Vec3& place) {
  const double length_squared = piece.along.squaredNorm();
  const double part = length_squared > 0.0 ? std::clamp((place - piece.from).dot(piece.along) / length_squared, 0.0, 1.0) : 0.0;
  return (place - piece.from - part * piece.along).squaredNorm();
}

}  // namespace

std::vector<double> distances_from(const Surface& surface, std::span<const LevelLoop> loops, std::span<const Vec3> places) {
  const std::vector<Piece> pieces = pieces_of(surface, loops);
  if (pieces.empty()) return {};
  std::vector<double> distances;
  distances.reserve(places.size());
  for (const Vec3& place : places) {
    double least = std::numeric_limits<double>::infinity();
    for (const Piece& piece : pieces) least = std::min(least, squared_distance(piece, place));
    distances.push_back(std::sqrt(least));
  }
  return distances;
}

}  // namespace palpation
