#include "world/closed_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/cross.h"

namespace palpation {
namespace {

/// Whether a ray from the place along u crosses a side; half open, so that a corner on the ray
/// counts once.
bool ray_crosses(const Vec2& place, const Vec2& from, const Vec2& to) {
  if ((from.y() > place.y()) == (to.y() > place.y())) return false;
  const double side = cross(to - from, place - from);
  return to.y() > from.y() ? side > 0.0 : side < 0.0;
}

int turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double area = cross(b - a, c - a);
  return (area > 0.0) - (area < 0.0);
}

bool boxes_overlap(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return (a.cwiseMin(b).array() <= c.cwiseMax(d).array()).all() &&
         (c.cwiseMin(d).array() <= a.cwiseMax(b).array()).all();
}

bool sides_touch(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return boxes_overlap(a, b, c, d) && turn(a, b, c) * turn(a, b, d) <= 0 &&
         turn(c, d, a) * turn(c, d, b) <= 0;
}

bool folds_back(const Vec2& a, const Vec2& corner, const Vec2& b) {
  return turn(a, corner, b) == 0 && (a - corner).dot(b - corner) > 0.0;
}

}  // namespace

ClosedLines::ClosedLines(std::vector<std::vector<Vec2>> lines) {
  for (const std::vector<Vec2>& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i)
      segments_.push_back({line[i], line[(i + 1) % line.size()]});
  }
}

double ClosedLines::signed_distance(const Vec2& place) const {
  double least = std::numeric_limits<double>::infinity();
  bool is_inside = false;
  for (const Segment<2>& segment : segments_) {
    least = std::min(least, segment.squared_distance(place));
    is_inside ^= ray_crosses(place, segment.from, segment.to);
  }
  return is_inside ? std::sqrt(least) : -std::sqrt(least);
}

std::optional<std::pair<int, int>> sides_that_meet(const std::vector<Vec2>& line) {
  const int count = static_cast<int>(line.size());
  const auto end = [&](int side) { return line[(side + 1) % count]; };
  for (int i = 0; i < count; ++i) {
    if (folds_back(line[i], end(i), line[(i + 2) % count])) return std::pair(i, (i + 1) % count);
    for (int j = i + 2; j < count; ++j) {
      const bool are_neighbours = i == 0 && j == count - 1;
      if (!are_neighbours && sides_touch(line[i], end(i), line[j], end(j))) return std::pair(i, j);
    }
  }
  return std::nullopt;
}

}  // namespace palpation
