/// Small surfaces whose areas, distances and topology are known, for tests of every floor.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "palpation/base/random.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/geometry/surface.h"
#include "palpation/geometry/triangle_mesh.h"

namespace palpation::zoo {

/// [0, 1] x [0, 1] at z = 0.
inline TriangleMesh unit_square_mesh(int cells_per_side) {
  Random unused(0);
  return make_plane(
      {.size_m = Vec2(1.0, 1.0), .columns = cells_per_side + 1, .rows = cells_per_side + 1},
      unused);
}

inline Surface unit_square(int cells_per_side) { return Surface(unit_square_mesh(cells_per_side)); }

/// The unit square with its inner vertices moved.
inline TriangleMesh jittered_square_mesh(int cells_per_side, std::uint64_t seed) {
  Random random(seed);
  return make_plane({.size_m = Vec2(1.0, 1.0),
                     .columns = cells_per_side + 1,
                     .rows = cells_per_side + 1,
                     .jitter = 0.4},
                    random);
}

inline Surface jittered_square(int cells_per_side, std::uint64_t seed) {
  return Surface(jittered_square_mesh(cells_per_side, seed));
}

/// Corners at the origin and at 1 on each axis.
inline TriangleMesh tetrahedron_mesh() {
  TriangleMesh mesh{Points(4, 3), Triangles(4, 3)};
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  mesh.triangles << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
  return mesh;
}

inline TriangleMesh icosahedron_mesh() {
  const double t = std::numbers::phi;
  TriangleMesh mesh{Points(12, 3), Triangles(20, 3)};
  mesh.vertices << -1, t, 0, 1, t, 0, -1, -t, 0, 1, -t, 0, 0, -1, t, 0, 1, t, 0, -1, -t, 0, 1, -t,
      t, 0, -1, t, 0, 1, -t, 0, -1, -t, 0, 1;
  mesh.triangles << 0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4, 11, 10, 2,
      10, 7, 6, 7, 1, 8,  //
      3, 9, 4, 3, 4, 2, 3, 2, 6, 3, 6, 8, 3, 8, 9, 4, 9, 5, 2, 4, 11, 6, 2, 10, 8, 6, 7, 9, 8, 1;
  mesh.vertices.rowwise().normalize();
  return mesh;
}

/// The unit sphere: 20 * 4^levels triangles.
inline TriangleMesh icosphere_mesh(int levels) {
  TriangleMesh mesh = icosahedron_mesh();
  for (int level = 0; level < levels; ++level) {
    double longest = 0.0;
    for (const auto& t : mesh.triangles.rowwise()) {
      for (int i = 0; i < 3; ++i)
        longest =
            std::max(longest, (mesh.vertices.row(t[i]) - mesh.vertices.row(t[(i + 1) % 3])).norm());
    }
    mesh = refine(mesh, 0.9 * longest);  // one pass
    mesh.vertices.rowwise().normalize();
  }
  return mesh;
}

/// A grid of columns x rows cells, rolled up where it is closed that way; place(c / columns, r /
/// rows) says where its vertices are.
template <typename Place>
TriangleMesh rolled_grid_mesh(int columns, int rows, bool columns_close, bool rows_close,
                              Place place) {
  const int across = columns_close ? columns : columns + 1, along = rows_close ? rows : rows + 1;
  TriangleMesh mesh{Points(across * along, 3), Triangles(2 * columns * rows, 3)};
  for (int r = 0; r < along; ++r) {
    for (int c = 0; c < across; ++c) {
      const Vec3 x = place(static_cast<double>(c) / columns, static_cast<double>(r) / rows);
      mesh.vertices.row(r * across + c) = x;
    }
  }
  int face = 0;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const auto vertex = [&](int dc, int dr) {
        return (r + dr) % along * across + (c + dc) % across;
      };
      mesh.triangles.row(face++) << vertex(0, 0), vertex(1, 0), vertex(1, 1);
      mesh.triangles.row(face++) << vertex(0, 0), vertex(1, 1), vertex(0, 1);
    }
  }
  return mesh;
}

/// Around the z axis from z = 0, open at both ends.
inline TriangleMesh cylinder_mesh(double radius, double height, int around, int along) {
  return rolled_grid_mesh(around, along, true, false, [=](double u, double v) {
    const double angle = 2.0 * std::numbers::pi * u;
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), height * v);
  });
}

inline TriangleMesh torus_mesh(double large, double small, int around, int across) {
  return rolled_grid_mesh(around, across, true, true, [=](double u, double v) {
    const double a = 2.0 * std::numbers::pi * u, b = 2.0 * std::numbers::pi * v;
    const double reach = large + small * std::cos(b);
    return Vec3(reach * std::cos(a), reach * std::sin(a), small * std::sin(b));
  });
}

/// Flat, between two circles around the origin at z = 0, normal along +z.
inline TriangleMesh annulus_mesh(double inner, double outer, int around, int across) {
  return rolled_grid_mesh(around, across, true, false, [=](double u, double v) {
    const double angle = -2.0 * std::numbers::pi * u, radius = inner + (outer - inner) * v;
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  });
}

/// Two meshes that do not touch, as one.
inline TriangleMesh together(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh both{Points(a.vertices.rows() + b.vertices.rows(), 3),
                    Triangles(a.triangles.rows() + b.triangles.rows(), 3)};
  both.vertices << a.vertices, b.vertices;
  both.triangles << a.triangles,
      (b.triangles.array() + static_cast<int>(a.vertices.rows())).matrix();
  return both;
}

/// scale * rotation * x + shift.
inline TriangleMesh moved(TriangleMesh mesh, const Eigen::Matrix3d& rotation, const Vec3& shift,
                          double scale = 1.0) {
  mesh.vertices =
      ((scale * mesh.vertices * rotation.transpose()).rowwise() + shift.transpose()).eval();
  return mesh;
}

/// A rotation that is aligned with nothing: about (1, 2, 3) by 1 radian.
inline Eigen::Matrix3d some_rotation() {
  const Vec3 axis = Vec3(1.0, 2.0, 3.0).normalized();
  Eigen::Matrix3d cross;
  cross << 0.0, -axis.z(), axis.y(), axis.z(), 0.0, -axis.x(), -axis.y(), axis.x(), 0.0;
  return Eigen::Matrix3d::Identity() + std::sin(1.0) * cross +
         (1.0 - std::cos(1.0)) * cross * cross;
}

/// A permutation of 0 .. count - 1.
inline std::vector<int> shuffled(int count, Random& random) {
  std::vector<int> order(count);
  for (int i = 0; i < count; ++i) order[i] = i;
  for (int i = count - 1; i > 0; --i) std::swap(order[i], order[random.below(i + 1)]);
  return order;
}

/// The same surface: vertex v becomes new_number[v]. Faces keep their order.
inline TriangleMesh relabelled(const TriangleMesh& mesh, const std::vector<int>& new_number) {
  TriangleMesh other = mesh;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
    other.vertices.row(new_number[v]) = mesh.vertices.row(v);
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i)
    other.triangles.data()[i] = new_number[mesh.triangles.data()[i]];
  return other;
}

/// The same surface with its faces in another order, each starting at another corner.
inline TriangleMesh reordered(const TriangleMesh& mesh, Random& random) {
  const std::vector<int> order = shuffled(static_cast<int>(mesh.triangles.rows()), random);
  TriangleMesh other = mesh;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const int turn = random.below(3);
    for (int i = 0; i < 3; ++i) other.triangles(order[f], i) = mesh.triangles(f, (i + turn) % 3);
  }
  return other;
}

struct Animal {
  std::string name;
  TriangleMesh mesh;
  Topology topology;
};

/// One of each kind. Topology: components, borders, Euler number, handles.
inline std::vector<Animal> animals() {
  return {{"square", unit_square_mesh(4), {1, 1, 1, 0}},
          {"jittered square", jittered_square_mesh(6, 1), {1, 1, 1, 0}},
          {"tetrahedron", tetrahedron_mesh(), {1, 0, 2, 0}},
          {"icosphere", icosphere_mesh(2), {1, 0, 2, 0}},
          {"cylinder", cylinder_mesh(1.0, 2.0, 12, 5), {1, 2, 0, 0}},
          {"torus", torus_mesh(2.0, 0.7, 12, 8), {1, 0, 0, 1}},
          {"annulus", annulus_mesh(0.5, 1.0, 12, 3), {1, 2, 0, 0}},
          {"sphere and torus",
           together(icosphere_mesh(1), moved(torus_mesh(2.0, 0.7, 9, 7),
                                             Eigen::Matrix3d::Identity(), Vec3(5.0, 0.0, 0.0))),
           {2, 0, 2, 1}}};
}

}  // namespace palpation::zoo
