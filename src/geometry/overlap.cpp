#include "geometry/overlap.h"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace palpation {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// A loop that never turns right (but by rounding), and turns around once: it bounds a convex part of the plane, once.
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
  int face;
  Vec2 from;
  Vec2 to;
};

using Corners = std::array<Vec2, 3>;

Corners corners_of(const Triangles& triangles, Eigen::Index face, const Points2& uv) {
  return {uv.row(triangles(face, 0)), uv.row(triangles(face, 1)), uv.row(triangles(face, 2))};
}

/// Inside each triangle at the border, along its border edge.
std::vector<Line> lines_inside(const Triangles& triangles, const Triangles& neighbours, const Points2& uv, double rounding) {
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
      lines.push_back({face, (1.0 - 2.0 * inset) * a + inset * b + inset * c, inset * a + (1.0 - 2.0 * inset) * b + inset * c});
    }
  }
  return lines;
}

/// The middle of the part of the line that is inside the triangle, and not just at its rim.
std::optional<Vec2> part_inside(const Line& line, const Corners& at, double rim) {
  double first = 0.0;
  double last = 1.0;
  for (int corner = 0; corner < 3; ++corner) {
    const Vec2 along = (at[(corner + 1) % 3] - at[corner]).normalized();
    const double from = cross(along, line.from - at[corner]) - rim;
    const double to = cross(along, line.to - at[corner]) - rim;
    if (from < 0.0 && to < 0.0) return std::nullopt;
    if (from < 0.0) first = std::max(first, from / (from - to));
    if (to < 0.0) last = std::min(last, from / (from - to));
  }
  if (first >= last) return std::nullopt;
  return Vec2(line.from + 0.5 * (first + last) * (line.to - line.from));
}

using PlainBox = CGAL::Box_intersection_d::Box_d<double, 2>;

struct NumberedBox : public PlainBox {
  NumberedBox(const CGAL::Bbox_2& box, int of) : PlainBox(box), number(of) {}
  int number;
};

CGAL::Bbox_2 box_of(const Vec2& a, const Vec2& b) {
  return {std::min(a.x(), b.x()), std::min(a.y(), b.y()), std::max(a.x(), b.x()), std::max(a.y(), b.y())};
}

}  // namespace

std::optional<Vec2> place_of_overlap(const Triangles& triangles, const Triangles& neighbours,
                                     const std::vector<std::vector<int>>& border_loops, const Points2& uv) {
  if (border_loops.size() == 1 && is_convex(border_loops.front(), uv)) return std::nullopt;
  const double rounding = 64.0 * std::numeric_limits<double>::epsilon() * uv.cwiseAbs().maxCoeff();
  const std::vector<Line> lines = lines_inside(triangles, neighbours, uv, rounding);
  std::vector<NumberedBox> line_boxes;
  for (const Line& line : lines) line_boxes.emplace_back(box_of(line.from, line.to), static_cast<int>(line_boxes.size()));
  std::vector<NumberedBox> face_boxes;
  for (int face = 0; face < triangles.rows(); ++face) {
    const Corners at = corners_of(triangles, face, uv);
    face_boxes.emplace_back(box_of(at[0], at[1]) + box_of(at[1], at[2]), face);
  }

  std::optional<Vec2> found;
  int first = std::numeric_limits<int>::max();  // the line with the lowest number, whatever order the boxes come in
  const auto look = [&](const NumberedBox& line_box, const NumberedBox& face_box) {
    const Line& line = lines[line_box.number];
    if (line_box.number >= first || line.face == face_box.number) return;
    const std::optional<Vec2> place = part_inside(line, corners_of(triangles, face_box.number, uv), rounding);
    if (!place) return;
    found = place;
    first = line_box.number;
  };
  CGAL::box_intersection_d(line_boxes.begin(), line_boxes.end(), face_boxes.begin(), face_boxes.end(), look);
  return found;
}

}  // namespace palpation
