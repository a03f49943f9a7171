#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "geometry/half_edges.h"
#include "geometry/trim.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Rows (mean of neighbours - x) of the inner vertices; those of the border are empty.
Sparse umbrellas(const TriangleMesh& mesh) {
  const int count = static_cast<int>(mesh.vertices.rows());
  std::vector<std::vector<int>> around(static_cast<std::size_t>(count));
  std::vector<bool> at_border(static_cast<std::size_t>(count), false);
  const EdgeTable edges(mesh.triangles, count);
  for (int edge = 0; edge < edges.size(); ++edge) {
    const auto sides = edges.half_edges(edge);
    const int a = half_edge_start(mesh.triangles, sides[0]),
              b = half_edge_end(mesh.triangles, sides[0]);
    around[static_cast<std::size_t>(a)].push_back(b);
    around[static_cast<std::size_t>(b)].push_back(a);
    if (sides.size() == 1)
      at_border[static_cast<std::size_t>(a)] = at_border[static_cast<std::size_t>(b)] = true;
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (int vertex = 0; vertex < count; ++vertex) {
    const auto i = static_cast<std::size_t>(vertex);
    if (at_border[i]) continue;
    entries.emplace_back(vertex, vertex, -1.0);
    for (const int other : around[i])
      entries.emplace_back(vertex, other, 1.0 / static_cast<double>(around[i].size()));
  }
  Sparse rows(count, count);
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

Points normals_of(const TriangleMesh& mesh) {
  Points normals = Points::Zero(mesh.vertices.rows(), 3);
  for (const auto& t : mesh.triangles.rowwise()) {
    const Vec3 a = mesh.vertices.row(t[0]), b = mesh.vertices.row(t[1]),
               c = mesh.vertices.row(t[2]);
    const Vec3 normal = (b - a).cross(c - a);
    for (int i = 0; i < 3; ++i) normals.row(t[i]) += normal;
  }
  return normals.rowwise().normalized();
}

}  // namespace

TriangleMesh fair(TriangleMesh mesh, double scale, const Vec3& along) {
  const Sparse rows = umbrellas(mesh);
  Sparse equations = 16.0 * std::pow(scale, 4) * Sparse(rows.transpose() * rows);
  for (int i = 0; i < equations.rows(); ++i) equations.coeffRef(i, i) += 1.0;
  const Eigen::SimplicialLDLT<Sparse> factor(equations);
  if (factor.info() != Eigen::Success)
    throw NumericalError("fair: the equations of " + std::to_string(mesh.vertices.rows()) +
                         " vertices could not be factored");
  const Points solved = factor.solve(Eigen::MatrixXd(mesh.vertices));
  Points normals = along.isZero(0.0)
                       ? normals_of(mesh)
                       : Points(along.normalized().transpose().replicate(mesh.vertices.rows(), 1));
  const Field step = (solved - mesh.vertices).cwiseProduct(normals).rowwise().sum();
  mesh.vertices += step.asDiagonal() * normals;
  return mesh;
}

}  // namespace palpation
