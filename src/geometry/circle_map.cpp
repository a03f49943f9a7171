#include "geometry/circle_map.h"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <numbers>

namespace palpation {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

Points2 on_circle(const TriangleMesh& mesh, const std::vector<int>& border) {
  std::vector<double> so_far = {0.0};
  for (std::size_t k = 0; k < border.size(); ++k) {
    so_far.push_back(
        so_far.back() +
        (mesh.vertices.row(border[(k + 1) % border.size()]) - mesh.vertices.row(border[k])).norm());
  }
  Points2 places = Points2::Zero(mesh.vertices.rows(), 2);
  for (std::size_t k = 0; k < border.size(); ++k) {
    const double angle = 2.0 * std::numbers::pi * so_far[k] / so_far.back();
    places.row(border[k]) << std::cos(angle), std::sin(angle);
  }
  return places;
}

}  // namespace

Points2 circle_map(const TriangleMesh& mesh, const std::vector<int>& border) {
  Points2 places = on_circle(mesh, border);
  std::vector<int> row(mesh.vertices.rows(), 0);
  for (const int vertex : border) row[vertex] = -1;
  int count = 0;
  for (int& number : row) number = number < 0 ? -1 : count++;
  if (count == 0) return places;
  // Every inner edge is in two triangles, which run through it in opposite directions: each adds
  // its half of the pair.
  std::vector<Eigen::Triplet<double>> entries;
  Points2 pull = Points2::Zero(count, 2);
  for (const auto& t : mesh.triangles.rowwise()) {
    for (int i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3];
      if (row[a] < 0) continue;
      entries.emplace_back(row[a], row[a], 1.0);
      if (row[b] >= 0)
        entries.emplace_back(row[a], row[b], -1.0);
      else
        pull.row(row[a]) += places.row(b);
    }
  }
  SparseMatrix matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<SparseMatrix> solver(matrix);
  const Points2 inner = solver.solve(pull);
  for (int vertex = 0; vertex < places.rows(); ++vertex) {
    if (row[vertex] >= 0) places.row(vertex) = inner.row(row[vertex]);
  }
  return places;
}

}  // namespace palpation
