#include "geometry/laplacian.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "geometry/half_edges.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kLeastArea = 1e-9;    // of the longest edge's square
constexpr double kLumped = 3.0 / 8.0;  // of the mass; the rest is consistent

/// Heron's formula as Kahan (1986) arranged it, which keeps its digits in slivers.
double triangle_area(double x, double y, double z) {
  const double a = std::max({x, y, z}), c = std::min({x, y, z}),
               b = std::max(std::min(x, y), std::min(std::max(x, y), z));
  const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return std::max(0.25 * std::sqrt(std::max(product, 0.0)), kLeastArea * a * a);
}

/// Cotangent of the angle at the corner opposite of the edge from `corner` on, times four times the
/// area.
double opposite_dot(const MetricMesh& mesh, int face, int corner) {
  const double a = mesh.lengths(face, corner), b = mesh.lengths(face, (corner + 1) % 3),
               c = mesh.lengths(face, (corner + 2) % 3);
  return (b - a) * (b + a) + c * c;
}

double opposite_cotangent(const MetricMesh& mesh, int face, int corner) {
  return opposite_dot(mesh, face, corner) / (4.0 * area_of(mesh, face));
}

/// Where a corner lies if the edge starts at 0 and runs along x: beside it on the left.
Vec2 laid_out(double edge, double from_start, double from_end, double area) {
  return {(edge * edge + (from_start - from_end) * (from_start + from_end)) / (2.0 * edge),
          2.0 * area / edge};
}

/// The edge from corner i of face f becomes the other diagonal of its two triangles; false where
/// that is none.
bool flip(MetricMesh& mesh, int half_edge) {
  const int f = half_edge / 3, i = half_edge % 3;
  const int other = mesh.across(f, i), k = other / 3, j = other % 3;
  const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
  const int a = mesh.triangles(f, i), b = mesh.triangles(f, i1), c = mesh.triangles(f, i2),
            d = mesh.triangles(k, j2);
  const double ab = mesh.lengths(f, i), bc = mesh.lengths(f, i1), ca = mesh.lengths(f, i2),
               ad = mesh.lengths(k, j1), db = mesh.lengths(k, j2);
  const Vec2 above = laid_out(ab, ca, bc, area_of(mesh, f));
  Vec2 below = laid_out(ab, ad, db, area_of(mesh, k));
  below.y() = -below.y();
  const double crossing = above.x() + (below.x() - above.x()) * above.y() / (above.y() - below.y());
  if (!(crossing > 0.0 && crossing < ab)) return false;
  const double cd = (above - below).norm();

  const int across_bc = mesh.across(f, i1), across_ca = mesh.across(f, i2),
            across_ad = mesh.across(k, j1), across_db = mesh.across(k, j2);
  for (const int beyond : {across_bc, across_ca, across_ad, across_db}) {
    if (beyond >= 0 && (beyond / 3 == f || beyond / 3 == k))
      return false;  // a cone of two triangles
  }
  mesh.triangles.row(f) << a, d, c;
  mesh.lengths.row(f) << ad, cd, ca;
  mesh.triangles.row(k) << d, b, c;
  mesh.lengths.row(k) << db, bc, cd;
  mesh.across.row(f) << across_ad, 3 * k + 2, across_ca;
  mesh.across.row(k) << across_db, across_bc, 3 * f + 1;
  for (const int moved : {3 * f, 3 * f + 2, 3 * k, 3 * k + 1}) {
    const int beyond = mesh.across(moved / 3, moved % 3);
    if (beyond >= 0) mesh.across(beyond / 3, beyond % 3) = moved;
  }
  return true;
}

bool is_not_delaunay(const MetricMesh& mesh, int half_edge) {
  constexpr double kRounding = 1e-9;  // of cotangents: cocircular corners stay as they are
  const int beyond = mesh.across(half_edge / 3, half_edge % 3);
  if (beyond < 0 || beyond / 3 == half_edge / 3) return false;
  const double one = opposite_cotangent(mesh, half_edge / 3, half_edge % 3),
               other = opposite_cotangent(mesh, beyond / 3, beyond % 3);
  return one + other < -kRounding * (1.0 + std::abs(one));
}

}  // namespace

double area_of(const MetricMesh& mesh, int face) {
  return triangle_area(mesh.lengths(face, 0), mesh.lengths(face, 1), mesh.lengths(face, 2));
}

double angle_of(const MetricMesh& mesh, int face, int corner) {
  return std::atan2(4.0 * area_of(mesh, face), opposite_dot(mesh, face, (corner + 1) % 3));
}

MetricMesh metric_of(const Surface& surface) {
  const TriangleMesh& mesh = surface.mesh();
  MetricMesh metric{surface.vertex_count(), mesh.triangles,
                    MetricMesh::Lengths(mesh.triangles.rows(), 3),
                    Triangles(mesh.triangles.rows(), 3)};
  for (int face = 0; face < surface.face_count(); ++face) {
    for (int corner = 0; corner < 3; ++corner) {
      const int start = mesh.triangles(face, corner), end = mesh.triangles(face, (corner + 1) % 3);
      metric.lengths(face, corner) = (mesh.vertices.row(end) - mesh.vertices.row(start)).norm();
      const int next = surface.neighbour(face, corner);
      metric.across(face, corner) = -1;
      for (int other = 0; next >= 0 && other < 3; ++other) {
        if (mesh.triangles(next, other) == end && mesh.triangles(next, (other + 1) % 3) == start)
          metric.across(face, corner) = 3 * next + other;
      }
    }
  }
  return metric;
}

MetricMesh glued(int vertex_count, const Triangles& triangles, const MetricMesh::Lengths& lengths) {
  require((lengths.array() > 0.0).all() && lengths.allFinite(), "glued", "a length",
          "must be positive and finite");
  MetricMesh metric{vertex_count, triangles, lengths, Triangles::Constant(triangles.rows(), 3, -1)};
  const EdgeTable edges(triangles, vertex_count);
  for (int edge = 0; edge < edges.size(); ++edge) {
    const auto sides = edges.half_edges(edge);
    require(sides.size() <= 2, "glued", "an edge in " + std::to_string(sides.size()) + " triangles",
            "must be in one or two");
    if (sides.size() < 2) continue;
    metric.across(sides[0] / 3, sides[0] % 3) = sides[1];
    metric.across(sides[1] / 3, sides[1] % 3) = sides[0];
  }
  return metric;
}

void flip_to_delaunay(MetricMesh& mesh) {
  flip_to_delaunay(mesh, [](int, int) { return true; });
}

void flip_to_delaunay(MetricMesh& mesh,
                      const std::function<bool(int face, int beyond)>& may_trade) {
  const int count = static_cast<int>(3 * mesh.triangles.rows());
  std::vector<int> waiting;
  std::vector<bool> waits(static_cast<std::size_t>(count), false);
  for (int half_edge = count - 1; half_edge >= 0; --half_edge) {
    if (mesh.across(half_edge / 3, half_edge % 3) > half_edge) {
      waiting.push_back(half_edge);
      waits[half_edge] = true;
    }
  }
  // Flips end by themselves; where rounding lets slivers turn for ever, this ends them.
  constexpr long kMostPerEdge = 30;
  for (long left = kMostPerEdge * count; left > 0 && !waiting.empty(); --left) {
    const int half_edge = waiting.back();
    waiting.pop_back();
    waits[half_edge] = false;
    if (!is_not_delaunay(mesh, half_edge)) continue;
    const int f = half_edge / 3, k = mesh.across(f, half_edge % 3) / 3;
    if (!may_trade(f, k) || !flip(mesh, half_edge)) continue;
    for (const int side : {3 * f, 3 * f + 2, 3 * k, 3 * k + 1}) {
      if (mesh.across(side / 3, side % 3) < 0 || waits[side]) continue;
      waiting.push_back(side);
      waits[side] = true;
    }
  }
}

Laplacian laplacian_of(const MetricMesh& mesh) {
  using Triplet = Eigen::Triplet<double>;
  std::vector<Triplet> stiffness, mass;
  stiffness.reserve(12 * mesh.triangles.rows());
  mass.reserve(9 * mesh.triangles.rows());
  for (int face = 0; face < mesh.triangles.rows(); ++face) {
    const double area = area_of(mesh, face);
    for (int corner = 0; corner < 3; ++corner) {
      const int start = mesh.triangles(face, corner), end = mesh.triangles(face, (corner + 1) % 3);
      const double weight = 0.5 * opposite_cotangent(mesh, face, corner);
      stiffness.emplace_back(start, start, weight);
      stiffness.emplace_back(end, end, weight);
      stiffness.emplace_back(start, end, -weight);
      stiffness.emplace_back(end, start, -weight);
      mass.emplace_back(start, start, kLumped * area / 3.0 + (1.0 - kLumped) * area / 6.0);
      mass.emplace_back(start, end, (1.0 - kLumped) * area / 12.0);
      mass.emplace_back(end, start, (1.0 - kLumped) * area / 12.0);
    }
  }
  Laplacian laplacian{Eigen::SparseMatrix<double>(mesh.vertex_count, mesh.vertex_count),
                      Eigen::SparseMatrix<double>(mesh.vertex_count, mesh.vertex_count)};
  laplacian.stiffness.setFromTriplets(stiffness.begin(), stiffness.end());
  laplacian.mass.setFromTriplets(mass.begin(), mass.end());
  return laplacian;
}

}  // namespace palpation
