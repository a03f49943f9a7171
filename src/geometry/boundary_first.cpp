#include "geometry/boundary_first.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <numbers>

namespace palpation {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;
constexpr double kLeastSine = 1e-9;  // of an angle: slivers get weights that are large, and numbers

/// What the map needs of the mesh: angles, and the cotangent Laplacian G in parts, inner vertices
/// (I) and the border (B).
struct Operators {
  Eigen::VectorXd angles;       // summed around each vertex
  std::vector<bool> is_border;  // of a vertex
  std::vector<int> row;  // of an inner vertex among these, of a border vertex along the border
  SparseMatrix inner, inner_border;  // G_II, G_IB
  Eigen::Index inner_count = 0;
};

Operators operators_of(const TriangleMesh& mesh, const std::vector<int>& border) {
  Operators made;
  const Eigen::Index count = mesh.vertices.rows();
  made.angles = Eigen::VectorXd::Zero(count);
  made.row.assign(static_cast<std::size_t>(count), -1);
  made.is_border.assign(static_cast<std::size_t>(count), false);
  for (std::size_t k = 0; k < border.size(); ++k) {
    made.row[border[k]] = static_cast<int>(k);
    made.is_border[border[k]] = true;
  }
  for (int& row : made.row) {
    if (row < 0) row = static_cast<int>(made.inner_count++);
  }
  std::vector<Eigen::Triplet<double>> inner, across;
  inner.reserve(12 * static_cast<std::size_t>(mesh.triangles.rows()));
  for (const auto& t : mesh.triangles.rowwise()) {
    for (int i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
      const Vec3 here = mesh.vertices.row(c);
      const Vec3 to_a = mesh.vertices.row(a).transpose() - here,
                 to_b = mesh.vertices.row(b).transpose() - here;
      const double dot = to_a.dot(to_b), cross = to_a.cross(to_b).norm();
      made.angles[c] += std::atan2(cross, dot);
      const double weight = 0.5 * dot / std::max(cross, kLeastSine * (std::abs(dot) + cross));
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
        if (made.is_border[from]) continue;
        inner.emplace_back(made.row[from], made.row[from], weight);
        (made.is_border[to] ? across : inner).emplace_back(made.row[from], made.row[to], -weight);
      }
    }
  }
  made.inner.resize(made.inner_count, made.inner_count);
  made.inner.setFromTriplets(inner.begin(), inner.end());
  made.inner_border.resize(made.inner_count, static_cast<Eigen::Index>(border.size()));
  made.inner_border.setFromTriplets(across.begin(), across.end());
  return made;
}

/// A curve of these edge lengths that turns by these angles, its lengths changed as little as
/// closes it: l_i (1 - T_i . m), T the edges' directions (Sawhney and Crane 2017, section 4.3).
/// None if that would turn an edge round.
std::optional<Points2> closed_curve(const Eigen::VectorXd& lengths, const Eigen::VectorXd& turns) {
  const Eigen::Index count = lengths.size();
  Points2 directions(count, 2);
  double heading = 0.0;
  for (Eigen::Index k = 0; k < count; ++k) {
    heading += turns[k];
    directions.row(k) << std::cos(heading), std::sin(heading);
  }
  const Eigen::Matrix2d spread = directions.transpose() * lengths.asDiagonal() * directions;
  const Vec2 gap = directions.transpose() * lengths;
  const Eigen::VectorXd share = 1.0 - (directions * spread.inverse() * gap).array();
  if (!(share.minCoeff() > 0.0)) return std::nullopt;
  Points2 curve = Points2::Zero(count, 2);
  for (Eigen::Index k = 0; k + 1 < count; ++k)
    curve.row(k + 1) = curve.row(k) + lengths[k] * share[k] * directions.row(k);
  return curve;
}

}  // namespace

std::optional<Points2> boundary_first_map(const TriangleMesh& mesh,
                                          const std::vector<int>& border) {
  constexpr double kPi = std::numbers::pi;
  const Operators operators = operators_of(mesh, border);
  const auto count = static_cast<Eigen::Index>(border.size());
  Eigen::VectorXd lengths(count), turns(count), defects(operators.inner_count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const int vertex = border[k], next = border[(k + 1) % count];
    lengths[k] = (mesh.vertices.row(next) - mesh.vertices.row(vertex)).norm();
    turns[k] = kPi - operators.angles[vertex];
  }
  for (std::size_t vertex = 0; vertex < operators.row.size(); ++vertex) {
    if (!operators.is_border[vertex])
      defects[operators.row[vertex]] = 2.0 * kPi - operators.angles[vertex];
  }
  Eigen::SimplicialLDLT<SparseMatrix> factor;
  if (operators.inner_count > 0) {
    factor.compute(operators.inner);
    if (factor.info() != Eigen::Success) return std::nullopt;
    // Flat inside: G_II u = -defects with u = 0 on the border, whose turns become turns + G_BI u.
    turns -= operators.inner_border.transpose() * factor.solve(defects);
  }
  const std::optional<Points2> curve = closed_curve(lengths, turns);
  if (!curve) return std::nullopt;
  Points2 inner(operators.inner_count, 2);
  if (operators.inner_count > 0) inner = -factor.solve(operators.inner_border * *curve);
  Points2 uv(mesh.vertices.rows(), 2);
  for (Eigen::Index vertex = 0; vertex < uv.rows(); ++vertex) {
    const int row = operators.row[vertex];
    const Points2& part = operators.is_border[vertex] ? *curve : inner;
    uv.row(vertex) = part.row(row);
  }
  return uv.allFinite() ? std::optional(uv) : std::nullopt;
}

}  // namespace palpation
