#include "io/soup_repairs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "geometry/half_edges.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

/// Numbers of triangles, those with the same corners one after the other, each group in its order.
std::vector<std::size_t> by_corners(const std::vector<SoupTriangle>& triangles) {
  std::vector<std::array<int, 3>> sorted;
  sorted.reserve(triangles.size());
  for (const SoupTriangle& triangle : triangles) {
    sorted.push_back(triangle.corners);
    std::sort(sorted.back().begin(), sorted.back().end());
  }
  std::vector<std::size_t> order(triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(sorted[a], a) < std::pair(sorted[b], b);
  });
  return order;
}

bool same_corners(const SoupTriangle& a, const SoupTriangle& b) {
  return std::is_permutation(a.corners.begin(), a.corners.end(), b.corners.begin());
}

void keep_only(const std::vector<bool>& kept, std::vector<SoupTriangle>& triangles) {
  std::size_t count = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (kept[t]) triangles[count++] = triangles[t];
  }
  triangles.resize(count);
}

/// Of each triangle, the lowest number of its part: parts hang together by edges.
std::vector<int> parts_of(const std::vector<SoupTriangle>& triangles, std::size_t point_count) {
  Triangles corners(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    corners.row(static_cast<Eigen::Index>(t)) =
        Eigen::Map<const Eigen::RowVector3i>(triangles[t].corners.data());
  std::vector<int> part(triangles.size());
  std::iota(part.begin(), part.end(), 0);
  const auto first_of = [&](int t) {
    while (part[t] != t) t = part[t] = part[part[t]];
    return t;
  };
  const EdgeTable edges(corners, static_cast<int>(point_count));
  for (int edge = 0; edge < edges.size(); ++edge) {
    const std::span<const int> sides = edges.half_edges(edge);
    for (const int side : sides.subspan(1)) {
      const int a = first_of(sides[0] / 3), b = first_of(side / 3);
      part[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::size_t t = 0; t < part.size(); ++t) part[t] = first_of(static_cast<int>(t));
  return part;
}

/// In parts of the squared extent, so that all are numbers.
std::vector<double> areas_of(const PolygonSoup& soup, const std::vector<SoupTriangle>& triangles) {
  Vec3 low = soup.points.front(), high = low;
  for (const Vec3& point : soup.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const double extent = (0.5 * high - 0.5 * low).maxCoeff();
  std::vector<double> areas;
  for (const SoupTriangle& triangle : triangles) {
    const Vec3 a = soup.points[triangle.corners[0]];
    const Vec3 ab = (0.5 * soup.points[triangle.corners[1]] - 0.5 * a) / extent,
               ac = (0.5 * soup.points[triangle.corners[2]] - 0.5 * a) / extent;
    const double area = 0.5 * ab.cross(ac).norm();
    areas.push_back(std::isfinite(area) ? area : 0.0);
  }
  return areas;
}

}  // namespace

void Repaired::take(const PolygonSoup& soup, int face, std::span<const int> corners) {
  if (count_++ > 0) return;
  first_ = "face " + std::to_string(face + soup.first_number);
  if (soup.place_kind != PlaceKind::None)
    first_ += (soup.place_kind == PlaceKind::Line ? " in line " : " at byte ") +
              std::to_string(soup.places[static_cast<std::size_t>(face)]);
  const Vec3& corner = soup.points[corners.front()];
  first_ += ", whose first corner is at (" + text_of(corner.x()) + ", " + text_of(corner.y()) +
            ", " + text_of(corner.z()) + ") in the file's unit";
}

void Repaired::tell(PolygonSoup& soup, const std::string& one, const std::string& many,
                    const std::string& advice) const {
  if (count_ == 0) return;
  soup.warn(std::to_string(count_) + " " + (count_ == 1 ? one + ": " : many + ", the first: ") +
                first_ + ".",
            advice);
}

void drop_duplicates(PolygonSoup& soup, std::vector<SoupTriangle>& triangles) {
  std::vector<bool> kept(triangles.size(), true);
  const std::vector<std::size_t> order = by_corners(triangles);
  for (std::size_t i = 1; i < order.size(); ++i)
    kept[order[i]] = !same_corners(triangles[order[i]], triangles[order[i - 1]]);
  Repaired dropped;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!kept[t]) dropped.take(soup, triangles[t].face, triangles[t].corners);
  }
  dropped.tell(soup, "triangle with the corners of an earlier one was dropped",
               "triangles with the corners of an earlier one were dropped",
               "The first of each was kept.");
  keep_only(kept, triangles);
}

void keep_largest(PolygonSoup& soup, std::vector<SoupTriangle>& triangles) {
  const std::vector<int> part = parts_of(triangles, soup.points.size());
  const std::vector<double> areas = areas_of(soup, triangles);
  std::vector<double> area_of_part(triangles.size(), 0.0);
  for (std::size_t t = 0; t < triangles.size(); ++t) area_of_part[part[t]] += areas[t];
  const auto largest = static_cast<int>(std::max_element(area_of_part.begin(), area_of_part.end()) -
                                        area_of_part.begin());
  std::vector<bool> kept(triangles.size());
  Repaired dropped;
  std::int64_t parts = 0;
  double all = 0.0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    kept[t] = part[t] == part[largest];
    all += areas[t];
    if (kept[t]) continue;
    if (part[t] == static_cast<int>(t)) ++parts;
    dropped.take(soup, triangles[t].face, triangles[t].corners);
  }
  const double share = all > 0.0 ? 100.0 * (1.0 - area_of_part[largest] / all) : 0.0;
  const std::string of_smaller = " of " + std::to_string(parts) +
                                 (parts == 1 ? " smaller component, " : " smaller components, ") +
                                 text_of(std::round(share * 100.0) / 100.0) + " % of the area, ";
  dropped.tell(soup, "triangle" + of_smaller + "was dropped",
               "triangles" + of_smaller + "were dropped",
               "Look at it in the file that was read, if it may be tissue.");
  keep_only(kept, triangles);
}

}  // namespace palpation
