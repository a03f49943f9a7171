/// Small surfaces and fields for the tests of this folder.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/zoo.h"
#include "palpation/base/error.h"
#include "palpation/base/random.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/geometry/surface.h"

namespace palpation::testing {

/// The unit square in z = 0.
inline Surface unit_square(int cells_per_side, double jitter = 0.0, std::uint64_t seed = 1) {
  Random random(seed);
  return Surface(make_plane({.size_m = {1.0, 1.0},
                             .columns = cells_per_side + 1,
                             .rows = cells_per_side + 1,
                             .corner_m = {0.0, 0.0},
                             .jitter = jitter},
                            random));
}

/// Four triangles up, four down, no border. Vertices +x, -x, +y, -y, +z, -z.
inline Surface octahedron() {
  TriangleMesh mesh{Points(6, 3), Triangles(8, 3)};
  mesh.vertices << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
  mesh.triangles << 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5;
  return Surface(mesh);
}

/// The square [-1, 1] x [-1, 1] as a fan of eight triangles around vertex 0 at the middle; the
/// border vertices 1 ... 8 run counter-clockwise from (1, 0). With a height, the middle is that
/// much above the rest: a tent, which is not planar.
inline Surface fan(double height = 0.0) {
  TriangleMesh mesh{Points(9, 3), Triangles(8, 3)};
  mesh.vertices << 0, 0, height, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0, -1, 0, 0, -1, -1, 0, 0, -1, 0,
      1, -1, 0;
  for (int i = 0; i < 8; ++i) mesh.triangles.row(i) << 0, 1 + i, 1 + (i + 1) % 8;
  return Surface(mesh);
}

/// The mesh without the cells that are not `kept`, told by their middle. Cells are pairs of
/// triangles, in order.
template <typename Kept>
TriangleMesh without_cells(TriangleMesh mesh, Kept kept) {
  Triangles left(mesh.triangles.rows(), 3);
  Eigen::Index count = 0;
  for (Eigen::Index face = 0; face + 1 < mesh.triangles.rows(); face += 2) {
    Vec3 middle = Vec3::Zero();
    for (int i = 0; i < 6; ++i)
      middle += mesh.vertices.row(mesh.triangles(face + i / 3, i % 3)).transpose() / 6.0;
    if (!kept(middle)) continue;
    left.row(count++) = mesh.triangles.row(face);
    left.row(count++) = mesh.triangles.row(face + 1);
  }
  mesh.triangles = left.topRows(count).eval();
  return mesh;
}

/// The unit square of nine cells without its middle cell.
inline Surface square_ring() {
  return Surface(without_cells(zoo::unit_square_mesh(3), [](const Vec3& p) {
    return (p - Vec3(0.5, 0.5, 0.0)).norm() > 0.1;
  }));
}

/// A ball cut off at its waist and at 25 degrees from its top: two borders, no chart.
inline Surface dome_with_hole(int around = 24, int along = 8) {
  return Surface(zoo::rolled_grid_mesh(around, along, true, false, [](double u, double v) {
    const double longitude = 2.0 * std::numbers::pi * u;
    const double latitude = std::numbers::pi * (0.5 - 0.14) * v;
    return Vec3(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                std::sin(latitude));
  }));
}

/// A quarter of a tube of radius 1 and length 1, with its outside away from the axis z.
inline Surface cylinder_patch(int cells) {
  return Surface(zoo::rolled_grid_mesh(cells, cells, false, false, [](double u, double v) {
    const double angle = 0.5 * std::numbers::pi * u;
    return Vec3(std::cos(angle), std::sin(angle), v);
  }));
}

inline Surface torus() { return Surface(zoo::torus_mesh(2.0, 0.7, 16, 9)); }

template <typename Function>
Field field_of(const Surface& surface, Function function) {
  Field field(surface.vertex_count());
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex)
    field[vertex] = function(surface.vertex(vertex));
  return field;
}

/// A few waves in random directions.
inline Field smooth_field(const Surface& surface, Random& random) {
  Field field = Field::Zero(surface.vertex_count());
  const double scale = 1.0 / surface.diameter();
  for (int wave = 0; wave < 5; ++wave) {
    const Vec3 direction = 5.6 * scale * Vec3(random.normal(), random.normal(), random.normal());
    const double phase = 2.0 * std::numbers::pi * random.uniform();
    field += field_of(surface, [&](const Vec3& p) { return std::sin(direction.dot(p) + phase); });
  }
  return field;
}

/// Every vertex for itself: loops in nearly every triangle, and many at the border.
inline Field rough_field(const Surface& surface, Random& random) {
  return field_of(surface, [&](const Vec3&) { return random.normal(); });
}

/// Whole numbers from 0 to 2, so that with level 1 a third of the vertices is exactly at the level:
/// plateaus, ridges, saddles.
inline Field stepped_field(const Surface& surface, Random& random) {
  return field_of(surface, [&](const Vec3&) { return static_cast<double>(random.below(3)); });
}

}  // namespace palpation::testing
