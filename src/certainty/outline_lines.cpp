#include "certainty/outline_lines.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "palpation/boundary/level_set.h"
#include "palpation/geometry/chart_place.h"

namespace palpation {
namespace {

constexpr int kLeastNodes = 12;

std::vector<Vec2> as_nodes(const std::vector<Vec2>& line) {
  double length = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i)
    length += (line[(i + 1) % line.size()] - line[i]).norm();
  return evenly_spaced(line, std::max(kLeastNodes, static_cast<int>(length / kSpacing_m)));
}

OutlineNodes alone(const std::vector<Vec2>& line) {
  OutlineNodes outline;
  outline.add(line, 0);
  return outline;
}

OutlineNodes but_the_last(const OutlineNodes& outline) {
  OutlineNodes fewer;
  for (std::size_t i = 0; i + 1 < outline.loops.size(); ++i)
    fewer.add(line_of(outline, outline.loops[i]), outline.loops[i].part);
  return fewer;
}

}  // namespace

std::vector<std::vector<Vec2>> lines_of(const Surface& surface, const Field& depth) {
  std::vector<std::vector<Vec2>> lines;
  for (const LevelLoop& loop : level_loops(surface, depth, 0.0)) {
    lines.emplace_back();
    for (const SurfacePoint& point : loop.points)
      lines.back().push_back(chart_place(surface, point));
  }
  std::ranges::stable_sort(lines, std::greater<>(), [](const std::vector<Vec2>& line) {
    return std::abs(enclosed_area(line));
  });
  return lines;
}

OutlineNodes outline_from(const std::vector<std::vector<Vec2>>& lines,
                          const std::vector<Vec2>& readings) {
  OutlineNodes outline;
  std::vector<OutlineNodes> parts;
  for (const std::vector<Vec2>& line : lines) {
    const OutlineNodes nodes = alone(as_nodes(line));
    const auto encloses = [&](const Vec2& place) { return is_inside(nodes, place); };
    if (!parts.empty() && std::ranges::none_of(readings, encloses)) continue;
    int part = static_cast<int>(parts.size());
    if (nodes.loops.front().turns < 0.0) {
      const auto holds = [&](const OutlineNodes& of) { return is_inside(of, nodes.place.front()); };
      const auto around = std::ranges::find_if(parts, holds);
      if (around == parts.end()) continue;
      part = static_cast<int>(around - parts.begin());
    } else {
      parts.push_back(nodes);
    }
    outline.add(nodes.place, part);
  }
  while (!outline.loops.empty() && !is_simple(outline)) outline = but_the_last(outline);
  return outline;
}

std::vector<Vec2> line_of(const OutlineNodes& outline, const NodeLoop& loop) {
  const auto first = outline.place.begin() + loop.first;
  return {first, first + loop.count};
}

double enclosed_area(const OutlineNodes& outline) {
  double area = 0.0;
  for (const NodeLoop& loop : outline.loops) area += enclosed_area(line_of(outline, loop));
  return area;
}

}  // namespace palpation
