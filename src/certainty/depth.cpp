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

std::vector<Piece> pieces_of(const Layout& layout, std::span<const LevelLoop> loops) {
  std::vector<Piece> pieces;
  for (const LevelLoop& loop : loops) {
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      if (loop.on_border[i]) continue;
      const Vec3 from = layout.at(loop.points[i]);
      pieces.push_back({from, layout.at(loop.points[(i + 1) % loop.points.size()]) - from});
    }
  }
  return pieces;
}

double squared_distance(const Piece& piece, const Vec3& place) {
  const double length_squared = piece.along.squaredNorm();
  const double part = length_squared > 0.0 ? std::clamp((place - piece.from).dot(piece.along) / length_squared, 0.0, 1.0) : 0.0;
  return (place - piece.from - part * piece.along).squaredNorm();
}

/// Consecutive pieces and a ball around them, which tells at once that they are far.
struct Stretch {
  std::size_t first, last;
  Vec3 centre;
  double radius;
};

constexpr std::size_t kPiecesPerStretch = 16;

std::vector<Stretch> stretches_of(const std::vector<Piece>& pieces) {
  std::vector<Stretch> stretches;
  for (std::size_t first = 0; first < pieces.size(); first += kPiecesPerStretch) {
    Stretch stretch{first, std::min(first + kPiecesPerStretch, pieces.size()), pieces[first].from, 0.0};
    for (std::size_t i = stretch.first; i < stretch.last; ++i) {
      const Vec3 offset = pieces[i].from - stretch.centre;
      stretch.radius = std::max({stretch.radius, offset.norm(), (offset + pieces[i].along).norm()});
    }
    stretches.push_back(stretch);
  }
  return stretches;
}

}  // namespace

std::vector<double> distances_from(const Layout& layout, std::span<const LevelLoop> loops, std::span<const Vec3> places) {
  const std::vector<Piece> pieces = pieces_of(layout, loops);
  if (pieces.empty()) return {};
  const std::vector<Stretch> stretches = stretches_of(pieces);
  std::vector<double> distances;
  distances.reserve(places.size());
  std::size_t nearest = 0;  // stretch: neighbours in the list are often neighbours in space
  for (const Vec3& place : places) {
    double least = std::numeric_limits<double>::infinity();
    const auto look_at = [&](std::size_t number) {
      const Stretch& stretch = stretches[number];
      const double gap = (place - stretch.centre).norm() - stretch.radius;
      if (gap > 0.0 && gap * gap >= least) return;
      for (std::size_t i = stretch.first; i < stretch.last; ++i) {
        const double distance = squared_distance(pieces[i], place);
        if (distance >= least) continue;
        least = distance;
        nearest = number;
      }
    };
    look_at(nearest);
    for (std::size_t number = 0; number < stretches.size(); ++number) look_at(number);
    distances.push_back(std::sqrt(least));
  }
  return distances;
}

}  // namespace palpation
