#include "certainty/outline_nodes.h"

#include <algorithm>
#include <cmath>

namespace palpation {

void OutlineNodes::add(const std::vector<Vec2>& line, int part) {
  loops.push_back({.first = count(),
                   .count = static_cast<int>(line.size()),
                   .part = part,
                   .turns = enclosed_area(line) < 0.0 ? -1.0 : 1.0});
  place.insert(place.end(), line.begin(), line.end());
  loop_of.resize(place.size(), static_cast<int>(loops.size()) - 1);
}

int OutlineNodes::parts() const {
  int count = 0;
  for (const NodeLoop& loop : loops) count = std::max(count, loop.part + 1);
  return count;
}

double enclosed_area(const std::vector<Vec2>& line) {
  double twice = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    // From the first place: far from the origin nothing is lost.
    twice += cross(line[i] - line[0], line[(i + 1) % line.size()] - line[0]);
  }
  return 0.5 * twice;
}

std::vector<Vec2> evenly_spaced(const std::vector<Vec2>& line, int count) {
  double length = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i)
    length += (line[(i + 1) % line.size()] - line[i]).norm();
  std::vector<Vec2> spaced;
  double walked = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec2 &from = line[i], &to = line[(i + 1) % line.size()];
    const double piece = (to - from).norm();
    while (static_cast<int>(spaced.size()) < count) {
      const double ahead = length * static_cast<double>(spaced.size()) / count - walked;
      if (ahead > piece) break;
      spaced.push_back(from + (piece > 0.0 ? ahead / piece : 0.0) * (to - from));
    }
    walked += piece;
  }
  while (static_cast<int>(spaced.size()) < count) spaced.push_back(line.back());
  return spaced;
}

namespace {

bool is_in_loop(const OutlineNodes& outline, const NodeLoop& loop, const Vec2& place) {
  bool inside = false;
  for (int node = loop.first; node < loop.first + loop.count; ++node)
    inside ^= crosses_ray(place, outline.place[node], outline.place[outline.next(node)]);
  return inside;
}

}  // namespace

std::vector<bool> nesting_of(const OutlineNodes& outline) {
  std::vector<bool> nesting;
  for (const NodeLoop& outer : outline.loops) {
    for (const NodeLoop& inner : outline.loops) {
      nesting.push_back(inner.first != outer.first &&
                        is_in_loop(outline, outer, outline.place[inner.first]));
    }
  }
  return nesting;
}

NearestPiece nearest_piece(const OutlineNodes& outline, const Vec2& place) {
  NearestPiece nearest{.square = 1e300};
  for (int node = 0; node < outline.count(); ++node) {
    const double square =
        squared_distance(place, outline.place[node], outline.place[outline.next(node)]);
    if (square < nearest.square) nearest = {square, node};
  }
  return nearest;
}

bool is_inside(const OutlineNodes& outline, const Vec2& place) {
  bool inside = false;
  for (const NodeLoop& loop : outline.loops) inside ^= is_in_loop(outline, loop, place);
  return inside;
}

double depth_in(const OutlineNodes& outline, const Vec2& place) {
  const double distance = std::sqrt(nearest_piece(outline, place).square);
  return is_inside(outline, place) ? distance : -distance;
}

bool is_simple(const OutlineNodes& outline) {
  for (int a = 0; a < outline.count(); ++a) {
    for (int b = a + 1; b < outline.count(); ++b) {
      if (b == outline.next(a) || a == outline.next(b)) continue;
      if (cross_each_other(outline.place[a], outline.place[outline.next(a)], outline.place[b],
                           outline.place[outline.next(b)]))
        return false;
    }
  }
  return true;
}

}  // namespace palpation
