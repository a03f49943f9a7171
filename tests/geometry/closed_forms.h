/// Heat kernels that are known, and the surfaces they are known on.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "geometry/laplacian.h"
#include "palpation/base/random.h"

namespace palpation::closed {

/// A rectangle whose opposite sides are one: no surface in space, but a metric mesh. Vertices
/// jittered by a quarter of a cell.
struct Periodic {
  Vec2 size;
  Points2 places;
  MetricMesh mesh;
};

inline Periodic periodic_rectangle(const Vec2& size, int columns, int rows) {
  Random random(5);
  const Vec2 cell(size.x() / columns, size.y() / rows);
  Periodic result{size, Points2(columns * rows, 2), {}};
  for (int v = 0; v < columns * rows; ++v) {
    const double jitter_x = 0.5 * random.uniform() - 0.25, jitter_y = 0.5 * random.uniform() - 0.25;
    result.places.row(v) << (v % columns + jitter_x) * cell.x(),
        (v / columns + jitter_y) * cell.y();
  }
  Triangles triangles(2 * columns * rows, 3);
  for (int row = 0, face = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto at = [&](int c, int r) { return r % rows * columns + c % columns; };
      const int a = at(column, row), b = at(column + 1, row), c = at(column + 1, row + 1),
                d = at(column, row + 1);
      triangles.row(face++) << a, b, c;
      triangles.row(face++) << a, c, d;
    }
  }
  MetricMesh::Lengths lengths(triangles.rows(), 3);
  for (Eigen::Index face = 0; face < triangles.rows(); ++face) {
    for (int corner = 0; corner < 3; ++corner) {
      Vec2 edge = result.places.row(triangles(face, (corner + 1) % 3)) -
                  result.places.row(triangles(face, corner));
      for (int axis = 0; axis < 2; ++axis)
        edge[axis] -= size[axis] * std::round(edge[axis] / size[axis]);
      lengths(face, corner) = edge.norm();
    }
  }
  result.mesh = glued(columns * rows, triangles, lengths);
  return result;
}

/// exp(-t L) over that of the plane at distance 0, t = length^2 / 2: a sum over the copies of a
/// place.
inline double periodic_heat(const Periodic& torus, int i, int j, double length) {
  double product = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double d = torus.places(i, axis) - torus.places(j, axis);
    double sum = 0.0;
    for (int copy = -3; copy <= 3; ++copy)
      sum += std::exp(-0.5 * std::pow((d + copy * torus.size[axis]) / length, 2));
    product *= sum;
  }
  return product;
}

/// The same on a sphere: sum of (2n+1) P_n(cos angle) exp(-t n (n+1) / R^2) / (4 pi R^2), times 2
/// pi length^2.
inline double sphere_heat(double radius, double cosine, double length) {
  const double t = 0.5 * length * length / (radius * radius);
  double sum = 0.0, before = 0.0, here = 1.0;  // Legendre polynomials
  for (int n = 0; n < 400; ++n) {
    sum += (2 * n + 1) * here * std::exp(-t * n * (n + 1));
    const double next = ((2 * n + 1) * cosine * here - n * before) / (n + 1);
    before = here;
    here = next;
  }
  return sum * t;
}

}  // namespace palpation::closed
