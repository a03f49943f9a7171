#include "geometry/flat_energy.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace palpation {
namespace {

constexpr double kThinnest = 1e-4;  // of the longest edge

Eigen::Matrix2d edges_in(const Triangles& triangles, Eigen::Index face, const Points2& uv) {
  Eigen::Matrix2d edges;
  edges.col(0) = (uv.row(triangles(face, 1)) - uv.row(triangles(face, 0))).transpose();
  edges.col(1) = (uv.row(triangles(face, 2)) - uv.row(triangles(face, 0))).transpose();
  return edges;
}

/// The triangle with its longest edge along x, and its corners in their order.
FlatTriangle flat_triangle(const std::array<Vec3, 3>& corners) {
  int longest = 0;
  for (int i = 1; i < 3; ++i) {
    if ((corners[(i + 1) % 3] - corners[i]).squaredNorm() >
        (corners[(longest + 1) % 3] - corners[longest]).squaredNorm())
      longest = i;
  }
  const Vec3 along = corners[(longest + 1) % 3] - corners[longest],
             arm = corners[(longest + 2) % 3] - corners[longest];
  const double base = along.norm();
  const double height = std::max(along.cross(arm).norm() / base, kThinnest * base);
  std::array<Vec2, 3> flat;
  flat[longest] = Vec2::Zero();
  flat[(longest + 1) % 3] = Vec2(base, 0.0);
  flat[(longest + 2) % 3] = Vec2(along.dot(arm) / base, height);
  Eigen::Matrix2d edges;
  edges << flat[1] - flat[0], flat[2] - flat[0];
  return {edges.inverse(), 0.5 * base * height};
}

/// |J - R|^2 and its derivative 2 (J - R), for the rotation R next to J.
double rigid(const Eigen::Matrix2d& j, Eigen::Matrix2d& derivative) {
  const double cosine = j(0, 0) + j(1, 1), sine = j(1, 0) - j(0, 1);
  const double length = std::hypot(cosine, sine);
  Eigen::Matrix2d rotation = Eigen::Matrix2d::Identity();
  if (length > 0.0) rotation << cosine / length, -sine / length, sine / length, cosine / length;
  derivative = 2.0 * (j - rotation);
  return (j - rotation).squaredNorm();
}

/// |J|^2 + |J^-1|^2 = |J|^2 (1 + 1 / det^2), less its least value, 4.
double barrier(const Eigen::Matrix2d& j, Eigen::Matrix2d& derivative) {
  const double square = j.squaredNorm(), det = j.determinant();
  Eigen::Matrix2d cofactors;
  cofactors << j(1, 1), -j(1, 0), -j(0, 1), j(0, 0);
  derivative = 2.0 * (1.0 + 1.0 / (det * det)) * j - (2.0 * square / (det * det * det)) * cofactors;
  return det > 0.0 ? square * (1.0 + 1.0 / (det * det)) - 4.0
                   : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<FlatTriangle> flat_triangles(const TriangleMesh& mesh) {
  std::vector<FlatTriangle> flat;
  flat.reserve(mesh.triangles.rows());
  for (const auto& t : mesh.triangles.rowwise())
    flat.push_back(
        flat_triangle({mesh.vertices.row(t[0]), mesh.vertices.row(t[1]), mesh.vertices.row(t[2])}));
  return flat;
}

Eigen::Matrix2d jacobian(const FlatTriangle& flat, const Triangles& triangles, Eigen::Index face,
                         const Points2& uv) {
  return edges_in(triangles, face, uv) * flat.to_plane;
}

double energy_at(FlatEnergy energy, const std::vector<FlatTriangle>& flat,
                 const Triangles& triangles, const Points2& uv, Points2& gradient) {
  gradient.setZero(uv.rows(), 2);
  double sum = 0.0;
  for (Eigen::Index face = 0; face < triangles.rows(); ++face) {
    const FlatTriangle& triangle = flat[face];
    const Eigen::Matrix2d j = jacobian(triangle, triangles, face, uv);
    Eigen::Matrix2d derivative;
    sum += triangle.area *
           (energy == FlatEnergy::Rigid ? rigid(j, derivative) : barrier(j, derivative));
    // The chain rule through the two edges from the first corner.
    const Eigen::Matrix2d pull = triangle.area * derivative * triangle.to_plane.transpose();
    gradient.row(triangles(face, 1)) += pull.col(0).transpose();
    gradient.row(triangles(face, 2)) += pull.col(1).transpose();
    gradient.row(triangles(face, 0)) -= (pull.col(0) + pull.col(1)).transpose();
  }
  return sum;
}

double way_to_first_turn(const Triangles& triangles, const Points2& uv, const Points2& step) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index face = 0; face < triangles.rows(); ++face) {
    // det(E + s D) = a s^2 + b s + c with c > 0: its least positive root, without cancellation.
    const Eigen::Matrix2d e = edges_in(triangles, face, uv), d = edges_in(triangles, face, step);
    const double a = d.determinant(), c = e.determinant();
    const double b = e(0, 0) * d(1, 1) + d(0, 0) * e(1, 1) - e(0, 1) * d(1, 0) - d(0, 1) * e(1, 0);
    const double inside = b * b - 4.0 * a * c;
    if (inside < 0.0 || (a >= 0.0 && b >= 0.0)) continue;
    const double root = 2.0 * c / (std::sqrt(inside) - b);
    if (root > 0.0) least = std::min(least, root);
  }
  return least;
}

}  // namespace palpation
