#include "geometry/overlap.h"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/cross.h"

namespace palpation {
namespace {

/// A loop that never turns right (but by rounding), and turns around once: it bounds a convex part
/// of the plane, once.
bool is_convex(const std::vector<int>& loop, const Points2& uv) {
  constexpr double kStraight = 1e-9;  // radians
  const std::size_t count = loop.size();
  double whole_turn = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec2 before = uv.row(loop[(k + 1) % count]) - uv.row(loop[k]);
    const Vec2 after = uv.row(loop[(k + 2) % count]) - uv.row(loop[(k + 1) % count]);
    const double turn = std::atan2(cross(before, after), before.dot(after));
    if (turn < -kStraight) return false;
    whole_turn += turn;
  }
  return whole_turn < 3.0 * std::numbers::pi;
}

struct Line {
  Vec2 from;
  Vec2 to;
};

using Corners = std::array<Vec2, 3>;

Corners corners_of(const Triangles& triangles, Eigen::Index face, const Points2& uv) {
  return {uv.row(triangles(face, 0)), uv.row(triangles(face, 1)), uv.row(triangles(face, 2))};
}

/// Inside each triangle at the border, along its border edge.
std::vector<Line> lines_inside(const Triangles& triangles, const Triangles& neighbours,
                               const Points2& uv, double rounding) {
  std::vector<Line> lines;
  for (int face = 0; face < triangles.rows(); ++face) {
    for (int corner = 0; corner < 3; ++corner) {
      if (neighbours(face, corner) >= 0) continue;
      const Corners at = corners_of(triangles, face, uv);
      const Vec2& a = at[corner];
      const Vec2& b = at[(corner + 1) % 3];
      const Vec2& c = at[(corner + 2) % 3];
      const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
      const double least_height = cross(b - a, c - a) / longest;
      const double inset = std::max(1e-6, 4.0 * rounding / least_height);
      if (inset > 0.25) continue;  // too thin to tell
      lines.push_back({(1.0 - 2.0 * inset) * a + inset * b + inset * c,
                       inset * a + (1.0 - 2.0 * inset) * b + inset * c});
    }
  }
  return lines;
}

double side(const Vec2& a, const Vec2& b, const Vec2& place) { return cross(b - a, place - a); }

/// Where the line crosses the segment from a to b, in the inside of both.
std::optional<Vec2> crossing(const Line& line, const Vec2& a, const Vec2& b) {
  const double from = side(a, b, line.from), to = side(a, b, line.to);
  if (!((from > 0.0 && to < 0.0) || (from < 0.0 && to > 0.0))) return std::nullopt;
  const double at_a = side(line.from, line.to, a), at_b = side(line.from, line.to, b);
  if (!((at_a > 0.0 && at_b < 0.0) || (at_a < 0.0 && at_b > 0.0))) return std::nullopt;
  return Vec2(line.from + from / (from - to) * (line.to - line.from));
}

/// From each border vertex to the next.
std::vector<Line> edges_of(const std::vector<std::vector<int>>& border_loops, const Points2& uv) {
  std::vector<Line> edges;
  for (const std::vector<int>& loop : border_loops) {
    for (std::size_t k = 0; k < loop.size(); ++k)
      edges.push_back({uv.row(loop[k]), uv.row(loop[(k + 1) % loop.size()])});
  }
  return edges;
}

using PlainBox = CGAL::Box_intersection_d::Box_d<double, 2>;

struct NumberedBox : public PlainBox {
  NumberedBox(const CGAL::Bbox_2& box, int of) : PlainBox(box), number(of) {}
  int number;
};

CGAL::Bbox_2 box_of(const Vec2& a, const Vec2& b) {
  return {std::min(a.x(), b.x()), std::min(a.y(), b.y()), std::max(a.x(), b.x()),
          std::max(a.y(), b.y())};
}

/// The first line that more than one triangle covers. The border runs around a place as often as
/// triangles cover it, which is counted along a ray to the right.
std::optional<Vec2> first_covered_twice(const std::vector<Line>& lines,
                                        const std::vector<Line>& border,
                                        std::vector<NumberedBox>& edge_boxes) {
  double right = -std::numeric_limits<double>::infinity();
  for (const Line& edge : border) right = std::max(right, edge.from.x());
  std::vector<NumberedBox> rays;
  std::vector<int> winding(lines.size(), 0);
  for (const Line& line : lines) {
    const Vec2 place = 0.5 * (line.from + line.to);
    rays.emplace_back(box_of(place, {right, place.y()}), static_cast<int>(rays.size()));
  }
  const auto count = [&](const NumberedBox& ray, const NumberedBox& edge_box) {
    const Vec2 place(ray.min_coord(0), ray.min_coord(1));
    const Line& edge = border[edge_box.number];
    const bool from_above = edge.from.y() > place.y(), to_above = edge.to.y() > place.y();
    if (from_above == to_above || (side(edge.from, edge.to, place) > 0.0) != to_above) return;
    winding[ray.number] += to_above ? 1 : -1;
  };
  CGAL::box_intersection_d(rays.begin(), rays.end(), edge_boxes.begin(), edge_boxes.end(), count);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (winding[i] > 1) return Vec2(0.5 * (lines[i].from + lines[i].to));
  }
  return std::nullopt;
}

}  // namespace

std::optional<Vec2> place_of_overlap(const Triangles& triangles, const Triangles& neighbours,
                                     const std::vector<std::vector<int>>& border_loops,
                                     const Points2& uv) {
  if (border_loops.size() == 1 && is_convex(border_loops.front(), uv)) return std::nullopt;
  const double rounding = 64.0 * std::numeric_limits<double>::epsilon() * uv.cwiseAbs().maxCoeff();
  const std::vector<Line> lines = lines_inside(triangles, neighbours, uv, rounding);
  const std::vector<Line> border = edges_of(border_loops, uv);
  std::vector<NumberedBox> line_boxes, edge_boxes;
  for (const Line& line : lines)
    line_boxes.emplace_back(box_of(line.from, line.to), static_cast<int>(line_boxes.size()));
  for (const Line& edge : border)
    edge_boxes.emplace_back(box_of(edge.from, edge.to), static_cast<int>(edge_boxes.size()));

  std::optional<Vec2> found;
  int first = std::numeric_limits<int>::max();  // the line with the lowest number, whatever order
                                                // the boxes come in
  const auto look = [&](const NumberedBox& line_box, const NumberedBox& edge_box) {
    if (line_box.number >= first) return;
    const Line& edge = border[edge_box.number];
    const std::optional<Vec2> place = crossing(lines[line_box.number], edge.from, edge.to);
    if (!place) return;
    found = place;
    first = line_box.number;
  };
  CGAL::box_intersection_d(line_boxes.begin(), line_boxes.end(), edge_boxes.begin(),
                           edge_boxes.end(), look);
  return found ? found : first_covered_twice(lines, border, edge_boxes);
}

}  // namespace palpation
