#include "geometry/topology.h"

namespace palpation {
namespace {

int count_components(const Triangles& neighbours) {
  std::vector<bool> reached(neighbours.rows(), false);
  std::vector<int> waiting;
  int components = 0;
  for (Eigen::Index first = 0; first < neighbours.rows(); ++first) {
    if (reached[first]) continue;
    ++components;
    reached[first] = true;
    waiting.push_back(static_cast<int>(first));
    while (!waiting.empty()) {
      const int face = waiting.back();
      waiting.pop_back();
      for (int i = 0; i < 3; ++i) {
        const int next = neighbours(face, i);
        if (next < 0 || reached[next]) continue;
        reached[next] = true;
        waiting.push_back(next);
      }
    }
  }
  return components;
}

}  // namespace

std::vector<std::vector<int>> walk_borders(const HalfEdgeMesh& mesh) {
  std::vector<std::vector<int>> loops;
  std::vector<bool> walked(mesh.n_vertices(), false);
  for (const OpenMesh::VertexHandle first : mesh.vertices()) {
    if (walked[first.idx()] || !mesh.is_boundary(first)) continue;
    std::vector<int>& loop = loops.emplace_back();
    // Half-edges outside the tissue have it on their right: walk them backwards.
    OpenMesh::HalfedgeHandle outside = mesh.prev_halfedge_handle(mesh.halfedge_handle(first));
    while (!walked[mesh.to_vertex_handle(outside).idx()]) {
      walked[mesh.to_vertex_handle(outside).idx()] = true;
      loop.push_back(mesh.to_vertex_handle(outside).idx());
      outside = mesh.prev_halfedge_handle(outside);
    }
  }
  return loops;
}

Topology count_topology(const HalfEdgeMesh& mesh, const Triangles& neighbours, int border_count) {
  Topology topology;
  topology.components = count_components(neighbours);
  topology.borders = border_count;
  topology.euler = static_cast<int>(mesh.n_vertices()) - static_cast<int>(mesh.n_edges()) +
                   static_cast<int>(mesh.n_faces());
  // Euler and Poincare: every component adds 2 - 2 handles - borders.
  topology.handles = (2 * topology.components - border_count - topology.euler) / 2;
  return topology;
}

}  // namespace palpation
