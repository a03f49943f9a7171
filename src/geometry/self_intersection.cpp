#include "geometry/self_intersection.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <vector>

namespace palpation {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corners = std::array<Kernel::Point_3, 3>;

constexpr std::int64_t kMostPairsPerTriangle = 100;

using PlainBox = CGAL::Box_intersection_d::Box_d<double, 3, CGAL::Box_intersection_d::ID_EXPLICIT>;

struct NumberedBox : PlainBox {
  NumberedBox(const CGAL::Bbox_3& box, int of) : PlainBox(box), number(of) {}
  int number;
};

struct TooManyPairs {};

Corners corners_of(const Surface& surface, int face) {
  Corners corners;
  for (int i = 0; i < 3; ++i) {
    const Vec3 place = surface.vertex(surface.triangle(face)[i]);
    corners[i] = {place.x(), place.y(), place.z()};
  }
  return corners;
}

std::vector<NumberedBox> boxes_of(const std::vector<Corners>& triangles) {
  std::vector<NumberedBox> boxes;
  boxes.reserve(triangles.size());
  for (std::size_t face = 0; face < triangles.size(); ++face) {
    const Corners& corners = triangles[face];
    boxes.emplace_back(corners[0].bbox() + corners[1].bbox() + corners[2].bbox(),
                       static_cast<int>(face));
  }
  return boxes;
}

/// Brings the corners that a has in common with b to the front of both, in the same order, and
/// tells how many they are.
std::size_t line_up(Corners& a, Corners& b) {
  std::size_t common = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto found = std::find(b.begin() + static_cast<std::ptrdiff_t>(common), b.end(), a[i]);
    if (found == b.end()) continue;
    std::iter_swap(found, b.begin() + static_cast<std::ptrdiff_t>(common));
    std::swap(a[i], a[common++]);
  }
  return common;
}

/// Triangles with an edge in common meet elsewhere only if one is folded onto the other.
bool are_folded(const Corners& a, const Corners& b) {
  return CGAL::coplanar(a[0], a[1], a[2], b[2]) &&
         CGAL::coplanar_orientation(a[0], a[1], a[2], b[2]) == CGAL::POSITIVE;
}

bool meets_opposite_side(const Corners& triangle, const Corners& other) {
  return CGAL::do_intersect(Kernel::Triangle_3(triangle[0], triangle[1], triangle[2]),
                            Kernel::Segment_3(other[1], other[2]));
}

bool intersect(Corners a, Corners b) {
  switch (line_up(a, b)) {
    case 0:
      return CGAL::do_intersect(Kernel::Triangle_3(a[0], a[1], a[2]),
                                Kernel::Triangle_3(b[0], b[1], b[2]));
    case 1:
      return meets_opposite_side(a, b) || meets_opposite_side(b, a);
    case 2:
      return are_folded(a, b);
    default:
      return true;
  }
}

}  // namespace

SelfIntersections self_intersections(const Surface& surface) {
  std::vector<Corners> triangles;
  triangles.reserve(surface.face_count());
  for (int face = 0; face < surface.face_count(); ++face)
    triangles.push_back(corners_of(surface, face));
  std::vector<NumberedBox> boxes = boxes_of(triangles);
  SelfIntersections found;
  std::int64_t looked_at = 0;
  const auto look_at = [&](const NumberedBox& a, const NumberedBox& b) {
    if (++looked_at > kMostPairsPerTriangle * surface.face_count()) throw TooManyPairs{};
    if (!intersect(triangles[a.number], triangles[b.number])) return;
    const std::array<int, 2> pair = {std::min(a.number, b.number), std::max(a.number, b.number)};
    ++found.pairs;
    if (!found.first || pair < *found.first) found.first = pair;
  };
  try {
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), look_at);
  } catch (const TooManyPairs&) {
    found.complete = false;
  }
  return found;
}

}  // namespace palpation
