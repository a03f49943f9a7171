/// Tissues for the tests of this folder.
#pragma once

#include <cmath>

#include "palpation/base/random.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/geometry/surface.h"

namespace palpation {

inline TriangleMesh sheet_mesh(double width_m, double height_m, double step_m) {
  Random random(0);
  const auto vertices_along = [&](double length_m) {
    return static_cast<int>(std::lround(length_m / step_m)) + 1;
  };
  return make_plane({.size_m = {width_m, height_m},
                     .columns = vertices_along(width_m),
                     .rows = vertices_along(height_m)},
                    random);
}

/// Flat tissue from the origin with vertices every step_m; vertex (row, column) has the number row
/// * columns + column.
inline Surface sheet(double width_m, double height_m, double step_m) {
  return Surface(sheet_mesh(width_m, height_m, step_m));
}

/// The same sheet bent around an axis along y, its middle line left where it was and its normal
/// outward: lengths along it stay the same but for the chords of the mesh.
inline Surface bent_sheet(double width_m, double height_m, double step_m, double radius_m) {
  TriangleMesh mesh = sheet_mesh(width_m, height_m, step_m);
  for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i) {
    const double angle = (mesh.vertices(i, 0) - 0.5 * width_m) / radius_m;
    mesh.vertices(i, 0) = 0.5 * width_m + radius_m * std::sin(angle);
    mesh.vertices(i, 2) = radius_m * (std::cos(angle) - 1.0);
  }
  return Surface(mesh);
}

}  // namespace palpation
