#include "palpation/geometry/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "geometry/half_edges.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr std::int64_t kMostTriangles = std::int64_t{1} << 27;

void check_mesh_to_refine(const TriangleMesh& mesh) {
  require(mesh.vertices.allFinite(), "refine", "a coordinate", "must be finite");
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const int vertex = mesh.triangles(f, i);
      if (vertex >= 0 && vertex < mesh.vertices.rows()) continue;
      throw InvalidInput("refine: triangle " + std::to_string(f) + ": vertex " +
                         std::to_string(vertex) + " must be between 0 and " +
                         std::to_string(mesh.vertices.rows() - 1));
    }
  }
}

double longest_edge_length(const TriangleMesh& mesh) {
  double longest = 0.0;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const Vec3 edge = mesh.vertices.row(mesh.triangles(f, (i + 1) % 3)) -
                        mesh.vertices.row(mesh.triangles(f, i));
      longest = std::max(longest, edge.norm());
    }
  }
  return longest;
}

/// Every pass halves the edges, so the number of triangles is known before the first of them is
/// made.
void check_triangles_needed(Eigen::Index triangles, double longest, double longest_edge_m) {
  std::int64_t needed = triangles;
  for (; longest > longest_edge_m && needed <= kMostTriangles; longest /= 2.0) needed *= 4;
  require(needed <= kMostTriangles, "refine", "longest_edge_m = " + text_of(longest_edge_m),
          "would need more than 2^27 triangles");
}

TriangleMesh split_every_triangle_in_four(const TriangleMesh& mesh) {
  const int vertex_count = static_cast<int>(mesh.vertices.rows());
  const EdgeTable edges(mesh.triangles, vertex_count);
  TriangleMesh finer;
  finer.vertices.resize(vertex_count + edges.size(), 3);
  finer.vertices.topRows(vertex_count) = mesh.vertices;
  Triangles midpoint(mesh.triangles.rows(), 3);  // of the edge from corner i to corner i + 1
  for (int e = 0; e < edges.size(); ++e) {
    const int any = edges.half_edges(e).front();
    const int start = half_edge_start(mesh.triangles, any),
              end = half_edge_end(mesh.triangles, any);
    finer.vertices.row(vertex_count + e) =
        0.5 * mesh.vertices.row(start) + 0.5 * mesh.vertices.row(end);
    for (int h : edges.half_edges(e)) midpoint(h / 3, h % 3) = vertex_count + e;
  }
  finer.triangles.resize(4 * mesh.triangles.rows(), 3);
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const auto corner = mesh.triangles.row(f);
    const auto middle = midpoint.row(f);
    finer.triangles.row(4 * f + 0) << corner[0], middle[0], middle[2];
    finer.triangles.row(4 * f + 1) << middle[0], corner[1], middle[1];
    finer.triangles.row(4 * f + 2) << middle[2], middle[1], corner[2];
    finer.triangles.row(4 * f + 3) << middle[0], middle[1], middle[2];
  }
  return finer;
}

}  // namespace

double extent_m(const TriangleMesh& mesh) {
  if (mesh.vertices.rows() == 0) return 0.0;
  return (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).maxCoeff();
}

TriangleMesh refine(TriangleMesh mesh, double longest_edge_m) {
  require(std::isfinite(longest_edge_m) && longest_edge_m > 0.0, "refine",
          "longest_edge_m = " + text_of(longest_edge_m), "must be positive and finite");
  check_mesh_to_refine(mesh);
  double longest = longest_edge_length(mesh);
  check_triangles_needed(mesh.triangles.rows(), longest, longest_edge_m);
  while (longest > longest_edge_m) {
    mesh = split_every_triangle_in_four(mesh);
    longest = longest_edge_length(mesh);
  }
  return mesh;
}

}  // namespace palpation
