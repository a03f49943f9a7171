#include "boundary/level_remarks.h"

#include <algorithm>
#include <limits>

#include "palpation/boundary/level_set.h"

namespace palpation {

namespace {

double way_around(const Surface& surface, int face) {
  const Eigen::Vector3i t = surface.triangle(face);
  return (surface.vertex(t[1]) - surface.vertex(t[0])).norm() +
         (surface.vertex(t[2]) - surface.vertex(t[1])).norm() +
         (surface.vertex(t[0]) - surface.vertex(t[2])).norm();
}

bool is_small(const Surface& surface, const LevelLoop& loop) {
  double length = 0.0;
  double least = std::numeric_limits<double>::infinity();
  Vec3 last = surface.position(loop.points.back());
  for (const SurfacePoint& point : loop.points) {
    const Vec3 here = surface.position(point);
    length += (here - last).norm();
    least = std::min(least, way_around(surface, point.face));
    last = here;
  }
  return length < least;
}

/// Vertices at the level, less those of triangles in which something is above it, or all of which
/// is at it.
int count_bare_vertices(const Surface& surface, const Field& field, double level) {
  std::vector<bool> bare(field.size());
  for (int vertex = 0; vertex < field.size(); ++vertex) bare[vertex] = field[vertex] == level;
  for (int face = 0; face < surface.face_count(); ++face) {
    const Eigen::Vector3i t = surface.triangle(face);
    const Vec3 values(field[t[0]], field[t[1]], field[t[2]]);
    if (values.maxCoeff() <= level && values.minCoeff() < level) continue;
    for (const int vertex : t) bare[vertex] = false;
  }
  return static_cast<int>(std::count(bare.begin(), bare.end(), true));
}

}  // namespace

std::vector<std::string> LevelRemarks::words() const {
  std::vector<std::string> words;
  if (small_loops == 1) {
    words.emplace_back(
        "1 loop of the boundary is smaller than a triangle of the mesh, which cannot show how "
        "large it really is");
  } else if (small_loops > 1) {
    words.push_back(std::to_string(small_loops) +
                    " loops of the boundary are smaller than a triangle of the mesh, which cannot "
                    "show how large they really are");
  }
  if (bare_vertices == 1) {
    words.emplace_back("1 vertex only just reaches the level and bounds no area");
  } else if (bare_vertices > 1) {
    words.push_back(std::to_string(bare_vertices) +
                    " vertices only just reach the level and bound no area");
  }
  return words;
}

LevelRemarks remarks_on_level_set(const Surface& surface, const Field& field, double level) {
  LevelRemarks remarks;
  for (const LevelLoop& loop : level_loops(surface, field, level))
    remarks.small_loops += is_small(surface, loop) ? 1 : 0;
  remarks.bare_vertices = count_bare_vertices(surface, field, level);
  return remarks;
}

}  // namespace palpation
