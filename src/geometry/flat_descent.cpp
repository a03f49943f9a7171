#include "geometry/flat_descent.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

namespace palpation {
namespace {

constexpr int kMostSteps = 1000;
constexpr std::size_t kRemembered = 8;
constexpr double kStandstill = 1e-12;  // of the mesh's size, about 1
constexpr double kRounding = 1e-14;    // of the energy's scale

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Twice the cotangent Laplacian, the second derivative of the rigid energy for fixed rotations,
/// without the first vertex, which stays.
SparseMatrix laplacian(const std::vector<FlatTriangle>& flat, const Triangles& triangles,
                       Eigen::Index vertices) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * flat.size());
  for (Eigen::Index face = 0; face < triangles.rows(); ++face) {
    Eigen::Matrix<double, 3, 2> slopes;  // of the three hat functions
    slopes.bottomRows<2>() = flat[face].to_plane;
    slopes.row(0) = -slopes.row(1) - slopes.row(2);
    const Eigen::Matrix3d stiffness = 2.0 * flat[face].area * slopes * slopes.transpose();
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        const int row = triangles(face, i) - 1, column = triangles(face, k) - 1;
        if (row >= 0 && column >= 0) entries.emplace_back(row, column, stiffness(i, k));
      }
    }
  }
  SparseMatrix matrix(vertices - 1, vertices - 1);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// In the order of memory.
double dot(const Points2& a, const Points2& b) {
  return a.reshaped<Eigen::RowMajor>().dot(b.reshaped<Eigen::RowMajor>());
}

/// A symmetric positive definite matrix, and its inverse for u and v in one go.
class Factored {
 public:
  explicit Factored(const SparseMatrix& matrix)
      : ldlt_(matrix), over_diagonal_(ldlt_.vectorD().cwiseInverse()) {}

  Points2 solve(const Eigen::Ref<const Points2>& right) const {
    const SparseMatrix& lower =
        ldlt_.matrixL().nestedExpression();  // unit diagonal, which may be stored
    Points2 x = ldlt_.permutationP() * right;
    for (Eigen::Index column = 0; column < x.rows(); ++column) {
      const double u = x(column, 0), v = x(column, 1);
      for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry) {
        if (entry.row() <= column) continue;
        x(entry.row(), 0) -= entry.value() * u;
        x(entry.row(), 1) -= entry.value() * v;
      }
    }
    for (Eigen::Index column = x.rows(); column-- > 0;) {
      double u = over_diagonal_[column] * x(column, 0), v = over_diagonal_[column] * x(column, 1);
      for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry) {
        if (entry.row() <= column) continue;
        u -= entry.value() * x(entry.row(), 0);
        v -= entry.value() * x(entry.row(), 1);
      }
      x.row(column) << u, v;
    }
    return ldlt_.permutationPinv() * x;
  }

 private:
  Eigen::SimplicialLDLT<SparseMatrix> ldlt_;
  Eigen::VectorXd over_diagonal_;
};

/// What the last steps taught about the energy's second derivative.
class Memory {
 public:
  void learn(Points2 step, Points2 change) {
    const double curvature = dot(step, change);
    if (!(curvature > 1e-14 * step.norm() * change.norm())) return;
    if (pairs_.size() == kRemembered) pairs_.pop_front();
    pairs_.push_back({std::move(step), std::move(change), 1.0 / curvature});
  }
  void forget() { pairs_.clear(); }

  /// The two loops of Nocedal (1980), `solve` between them.
  template <typename Solve>
  Points2 direction(const Points2& gradient, Solve solve) const {
    Points2 q = -gradient;
    std::array<double, kRemembered> share{};
    for (std::size_t i = pairs_.size(); i-- > 0;) {
      share[i] = pairs_[i].over_curvature * dot(pairs_[i].step, q);
      q -= share[i] * pairs_[i].change;
    }
    Points2 r = solve(q);
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      r += (share[i] - pairs_[i].over_curvature * dot(pairs_[i].change, r)) * pairs_[i].step;
    return r;
  }

 private:
  struct Pair {
    Points2 step, change;
    double over_curvature;
  };
  std::deque<Pair> pairs_;
};

}  // namespace

Points2 descended(FlatEnergy energy, const TriangleMesh& mesh, Points2 start) {
  const std::vector<FlatTriangle> flat = flat_triangles(mesh);
  const Factored factored(laplacian(flat, mesh.triangles, mesh.vertices.rows()));
  double area = 0.0;
  for (const FlatTriangle& triangle : flat) area += triangle.area;
  const auto solve = [&](const Points2& right) {
    Points2 left = Points2::Zero(right.rows(), 2);
    left.bottomRows(right.rows() - 1) = factored.solve(right.bottomRows(right.rows() - 1));
    return left;
  };

  Points2 gradient;
  double value = energy_at(energy, flat, mesh.triangles, start, gradient);
  Memory memory;
  for (int step = 0; step < kMostSteps; ++step) {
    Points2 way = memory.direction(gradient, solve);
    double slope = dot(way, gradient);
    if (!(slope < 0.0)) {
      memory.forget();
      way = solve(-gradient);
      slope = dot(way, gradient);
    }
    if (way.cwiseAbs().maxCoeff() <= kStandstill) break;
    double length = 1.0;
    if (energy == FlatEnergy::Barrier)
      length = std::min(1.0, 0.8 * way_to_first_turn(mesh.triangles, start, way));
    // Armijo's rule; close to the end the energy's change drowns in rounding, and full steps are
    // right.
    Points2 next, next_gradient;
    double next_value = 0.0;
    for (int halvings = 0; halvings < 40; ++halvings, length *= 0.5) {
      next = start + length * way;
      next_value = energy_at(energy, flat, mesh.triangles, next, next_gradient);
      if (next_value <= value + 1e-4 * length * slope + kRounding * (area + std::abs(value))) break;
    }
    if (!(next_value <= value + kRounding * (area + std::abs(value)))) break;
    memory.learn(next - start, next_gradient - gradient);
    start = std::move(next);
    gradient = std::move(next_gradient);
    value = next_value;
  }
  return start;
}

}  // namespace palpation
