#include "io/polygon_soup.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <limits>
#include <optional>

#include "geometry/cut_polygon.h"
#include "io/bucket_sort.h"
#include "io/soup_repairs.h"

namespace palpation {
namespace {

/// A fan triangle counts as positive if it holds more than this part of the polygon's area.
constexpr double kLeastFanArea = 1e-12;

void check_corners(const MeshSource& source, const PolygonSoup& soup, std::size_t face,
                   std::span<const int> corners, std::vector<int>& sorted) {
  const auto count = static_cast<std::int64_t>(soup.points.size());
  for (const int corner : corners) {
    if (corner >= 0 && corner < count) continue;
    soup.fail_at_face(source, face,
                      "vertex index " + std::to_string(std::int64_t{corner} + soup.first_number) +
                          " is out of range " + std::to_string(soup.first_number) + " to " +
                          std::to_string(count - 1 + soup.first_number));
  }
  sorted.assign(corners.begin(), corners.end());
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end())
    soup.fail_at_face(source, face,
                      "uses vertex " + std::to_string(*twice + soup.first_number) + " twice");
}

/// Without corners that follow themselves.
void drop_steps_on_the_spot(std::vector<int>& corners) {
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
}

/// Twice the vector area of a polygon (Newell), relative to its first corner.
Vec3 vector_area(const PolygonSoup& soup, std::span<const int> corners) {
  const Vec3& origin = soup.points[corners[0]];
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Vec3 a = soup.points[corners[i]] - origin;
    const Vec3 b = soup.points[corners[i + 1]] - origin;
    sum += a.cross(b);
  }
  return sum;
}

bool sees_all(const PolygonSoup& soup, std::span<const int> corners, std::size_t apex,
              const Vec3& area) {
  const std::size_t count = corners.size();
  const auto point = [&](std::size_t i) -> const Vec3& {
    return soup.points[corners[(apex + i) % count]];
  };
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const Vec3 normal = (point(i) - point(0)).cross(point(i + 1) - point(0));
    if (!(normal.dot(area) > kLeastFanArea * area.squaredNorm())) return false;
  }
  return true;
}

/// The first corner from which the whole polygon is seen.
std::optional<std::size_t> fan_apex(const PolygonSoup& soup, std::span<const int> corners) {
  const Vec3 area = vector_area(soup, corners);
  for (std::size_t apex = 0; apex < corners.size(); ++apex) {
    if (sees_all(soup, corners, apex, area)) return apex;
  }
  return std::nullopt;
}

void append_fan(std::span<const int> corners, std::size_t apex, int face,
                std::vector<SoupTriangle>& triangles) {
  const std::size_t count = corners.size();
  for (std::size_t i = 1; i + 1 < count; ++i) {
    triangles.push_back(
        {{corners[apex], corners[(apex + i) % count], corners[(apex + i + 1) % count]}, face});
  }
}

/// False where the polygon crosses itself.
bool append_cut(const PolygonSoup& soup, std::span<const int> corners, int face,
                std::vector<SoupTriangle>& triangles) {
  std::vector<Vec3> places;
  for (const int corner : corners) places.push_back(soup.points[corner]);
  const std::vector<std::array<int, 3>> cut = cut_polygon(places);
  for (const auto& [a, b, c] : cut)
    triangles.push_back({{corners[a], corners[b], corners[c]}, face});
  return !cut.empty();
}

std::array<int, 3> sorted_corners(const SoupTriangle& triangle) {
  std::array<int, 3> corners = triangle.corners;
  std::sort(corners.begin(), corners.end());
  return corners;
}

}  // namespace

std::span<const int> PolygonSoup::face(std::size_t index) const {
  const std::int64_t first = first_corner[index];
  const std::int64_t last = index + 1 < first_corner.size()
                                ? first_corner[index + 1]
                                : static_cast<std::int64_t>(corners.size());
  return {corners.data() + first, static_cast<std::size_t>(last - first)};
}

void PolygonSoup::begin_face(std::int64_t place) {
  first_corner.push_back(static_cast<std::int64_t>(corners.size()));
  places.push_back(place);
}

void PolygonSoup::warn_of_underflows(std::int64_t count) {
  if (count == 0) return;
  warn(std::to_string(count) + " coordinates are too small for a double and were taken as 0.",
       "Harmless: nothing can be measured that is so small.");
}

void PolygonSoup::end_face(const MeshSource& source) const {
  const std::int64_t count = static_cast<std::int64_t>(corners.size()) - first_corner.back();
  if (count >= 3 && count <= kMostCorners) return;
  fail_at_face(source, face_count() - 1,
               count < 3 ? "has " + std::to_string(count) + " corners; a face has at least 3"
                         : "has more than " + std::to_string(kMostCorners) +
                               " corners: cut it into triangles");
}

void PolygonSoup::fail_at_face(const MeshSource& source, std::size_t index,
                               const std::string& what) const {
  const std::string text =
      "face " + std::to_string(index + static_cast<std::size_t>(first_number)) + ": " + what;
  if (place_kind == PlaceKind::Line) source.fail_at_line(places[index], text);
  if (place_kind == PlaceKind::Byte)
    source.fail_at_byte(static_cast<std::size_t>(places[index]), text);
  source.fail(text);
}

void refuse_crowds(const MeshSource& source, const PolygonSoup& soup) {
  // Small meshes may be any tangle: Surface names the edge at fault. A closed surface has two
  // triangles for each vertex, and two more for every handle.
  constexpr std::size_t kFew = 250'000;
  const std::size_t triangles = soup.corners.size() - 2 * soup.face_count();
  if (triangles <= kFew) return;
  std::vector<bool> used(soup.points.size(), false);
  for (const int corner : soup.corners) {
    if (corner >= 0 && static_cast<std::size_t>(corner) < used.size()) used[corner] = true;
  }
  const auto vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
  if (triangles <= 3 * vertices) return;
  source.fail(
      std::to_string(triangles) + " triangles on " + std::to_string(vertices) +
      " vertices are more than three for each: a surface has about two, so these cannot be one");
}

std::vector<SoupTriangle> triangles_of(const MeshSource& source, PolygonSoup& soup,
                                       const MeshRepair& repair) {
  constexpr auto kMost = static_cast<std::size_t>(kMostPoints);
  if (soup.corners.size() > kMost || soup.points.size() > kMost)
    source.fail("more than 2^31 corners or vertices");
  std::vector<SoupTriangle> triangles;
  triangles.reserve(soup.corners.size() - std::min(soup.corners.size(), 2 * soup.face_count()));
  std::vector<int> corners, sorted;
  Repaired thin, cut;
  for (std::size_t face = 0; face < soup.face_count(); ++face) {
    corners.assign(soup.face(face).begin(), soup.face(face).end());
    if (repair.drop_flat) drop_steps_on_the_spot(corners);
    check_corners(source, soup, face, corners, sorted);
    if (corners.size() < 3) {
      thin.take(soup, static_cast<int>(face), corners);
      continue;
    }
    if (corners.size() > 3) cut.take(soup, static_cast<int>(face), corners);
    const std::optional<std::size_t> apex = corners.size() == 3 ? 0 : fan_apex(soup, corners);
    if (apex)
      append_fan(corners, *apex, static_cast<int>(face), triangles);
    else if (!repair.cut_polygons || !append_cut(soup, corners, static_cast<int>(face), triangles))
      soup.fail_at_face(source, face,
                        "is a polygon that no fan of triangles covers once: cut it into triangles");
  }
  thin.tell(soup, "face with fewer than three different corners was dropped",
            "faces with fewer than three different corners were dropped", "As was asked for.");
  if (repair.cut_polygons)
    cut.tell(soup, "face with more than three corners was cut into triangles",
             "faces with more than three corners were cut into triangles", "As was asked for.");
  return triangles;
}

void refuse_duplicates(const MeshSource& source, const PolygonSoup& soup,
                       const std::vector<SoupTriangle>& triangles) {
  struct Entry {
    std::array<int, 3> corners;
    int face;
    auto operator<=>(const Entry&) const = default;
  };
  std::vector<Entry> entries;
  entries.reserve(triangles.size());
  for (const SoupTriangle& triangle : triangles)
    entries.push_back({sorted_corners(triangle), triangle.face});
  const auto lowest = [](const Entry& entry) { return static_cast<std::size_t>(entry.corners[0]); };
  entries = sorted_in_buckets(entries, soup.points.size(), lowest, std::less<Entry>());
  const auto same = [](const Entry& a, const Entry& b) { return a.corners == b.corners; };
  const auto found = std::adjacent_find(entries.begin(), entries.end(), same);
  if (found == entries.end()) return;
  soup.fail_at_face(
      source, static_cast<std::size_t>((found + 1)->face),
      "has the corners of face " + std::to_string(found->face + soup.first_number) + " again");
}

std::int64_t drop_unused_points(PolygonSoup& soup, std::vector<SoupTriangle>& triangles) {
  std::vector<int> number(soup.points.size(), -1);
  for (const SoupTriangle& triangle : triangles) {
    for (const int corner : triangle.corners) number[corner] = 0;
  }
  int used = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] < 0) continue;
    soup.points[used] = soup.points[i];
    if (!soup.height_sd.empty()) soup.height_sd[used] = soup.height_sd[i];
    number[i] = used++;
  }
  const auto dropped = static_cast<std::int64_t>(soup.points.size()) - used;
  soup.points.resize(used);
  if (!soup.height_sd.empty()) soup.height_sd.resize(used);
  if (dropped == 0) return 0;
  for (SoupTriangle& triangle : triangles) {
    for (int& corner : triangle.corners) corner = number[corner];
  }
  return dropped;
}

}  // namespace palpation
