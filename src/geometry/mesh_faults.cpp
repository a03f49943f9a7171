#include "geometry/mesh_faults.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "geometry/check_mesh.h"
#include "geometry/half_edges.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

/// Corners of triangles, numbered as half-edges are, in groups that hang together: each group at a
/// vertex is a fan.
class Fans {
 public:
  explicit Fans(const Triangles& triangles) : parent_(static_cast<std::size_t>(triangles.size())) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  void join(int a, int b) { parent_[first_of(a)] = first_of(b); }

  int first_of(int corner) {
    while (parent_[corner] != corner) {
      int& parent = parent_[corner];
      parent = parent_[parent];
      corner = parent;
    }
    return corner;
  }

 private:
  std::vector<int> parent_;
};

/// The corner of a half-edge's triangle at a vertex that is one of its ends.
int corner_at(const Triangles& triangles, int half_edge, int vertex) {
  const int face = half_edge / 3;
  return triangles(face, half_edge % 3) == vertex ? half_edge : 3 * face + (half_edge % 3 + 1) % 3;
}

void check_indices(const TriangleMesh& mesh) {
  for (Eigen::Index face = 0; face < mesh.triangles.rows(); ++face) {
    const Eigen::Vector3i t = mesh.triangles.row(face);
    const bool exist = t.minCoeff() >= 0 && t.maxCoeff() < mesh.vertices.rows();
    require(exist && t[0] != t[1] && t[1] != t[2] && t[2] != t[0], "count_faults",
            "triangle " + std::to_string(face), "must have three different vertices that exist");
  }
}

int count_pinched(const TriangleMesh& mesh, Fans& fans) {
  std::vector<int> fan_of_vertex(static_cast<std::size_t>(mesh.vertices.rows()), -1);
  std::vector<bool> pinched(fan_of_vertex.size(), false);
  for (int corner = 0; corner < mesh.triangles.size(); ++corner) {
    const auto vertex = static_cast<std::size_t>(mesh.triangles(corner / 3, corner % 3));
    const int fan = fans.first_of(corner);
    if (fan_of_vertex[vertex] >= 0 && fan_of_vertex[vertex] != fan) pinched[vertex] = true;
    fan_of_vertex[vertex] = fan;
  }
  return static_cast<int>(std::count(pinched.begin(), pinched.end(), true));
}

}  // namespace

MeshFaults count_faults(const TriangleMesh& mesh) {
  check_indices(mesh);
  MeshFaults faults;
  for (Eigen::Index face = 0; face < mesh.triangles.rows(); ++face)
    faults.flat_triangles += has_area(mesh, face) ? 0 : 1;
  const EdgeTable edges(mesh.triangles, static_cast<int>(mesh.vertices.rows()));
  Fans fans(mesh.triangles);
  for (int edge = 0; edge < edges.size(); ++edge) {
    const std::span<const int> sides = edges.half_edges(edge);
    const int start = half_edge_start(mesh.triangles, sides[0]),
              end = half_edge_end(mesh.triangles, sides[0]);
    for (const int side : sides.subspan(1)) {
      for (const int vertex : {start, end})
        fans.join(corner_at(mesh.triangles, side, vertex),
                  corner_at(mesh.triangles, sides[0], vertex));
    }
    if (sides.size() > 2) ++faults.crowded_edges;
    if (sides.size() == 2 && half_edge_start(mesh.triangles, sides[1]) == start)
      ++faults.one_way_edges;
  }
  faults.pinched_vertices = count_pinched(mesh, fans);
  return faults;
}

}  // namespace palpation
