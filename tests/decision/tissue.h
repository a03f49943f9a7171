/// Tissues for the tests of this folder.
#pragma once

#include <numeric>
#include <vector>

#include "palpation/base/random.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/geometry/surface.h"

namespace palpation {

/// Flat tissue from the origin with vertices every step_m; vertex (row, column) has the number row
/// * columns + column.
inline Surface sheet(double width_m, double height_m, double step_m) {
  Random random(0);
  const auto vertices_along = [&](double length_m) {
    return static_cast<int>(std::lround(length_m / step_m)) + 1;
  };
  return Surface(make_plane({.size_m = {width_m, height_m},
                             .columns = vertices_along(width_m),
                             .rows = vertices_along(height_m)},
                            random));
}

/// A square sheet without its upper right quarter; cells_per_side is even.
inline Surface l_shape(double side_m, int cells_per_side) {
  Random random(0);
  const TriangleMesh square = make_plane(
      {.size_m = {side_m, side_m}, .columns = cells_per_side + 1, .rows = cells_per_side + 1},
      random);
  TriangleMesh shape{Points(square.vertices.rows(), 3), Triangles(square.triangles.rows(), 3)};
  std::vector<int> new_index(square.vertices.rows(), -1);
  Eigen::Index vertices = 0, faces = 0;
  for (Eigen::Index face = 0; face < square.triangles.rows(); ++face) {
    const auto corners = square.triangles.row(face);
    const Vec3 middle = (square.vertices.row(corners[0]) + square.vertices.row(corners[1]) +
                         square.vertices.row(corners[2])) /
                        3.0;
    if (middle.x() > 0.5 * side_m && middle.y() > 0.5 * side_m) continue;
    for (int i = 0; i < 3; ++i) {
      int& index = new_index[corners[i]];
      if (index < 0) {
        index = static_cast<int>(vertices);
        shape.vertices.row(vertices++) = square.vertices.row(corners[i]);
      }
      shape.triangles(faces, i) = index;
    }
    ++faces;
  }
  shape.vertices.conservativeResize(vertices, 3);
  shape.triangles.conservativeResize(faces, 3);
  return Surface(shape);
}

inline std::vector<int> all_vertices(const Surface& surface) {
  std::vector<int> vertices(surface.vertex_count());
  std::iota(vertices.begin(), vertices.end(), 0);
  return vertices;
}

}  // namespace palpation
