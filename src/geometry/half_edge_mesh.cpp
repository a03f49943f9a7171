#include "geometry/half_edge_mesh.h"

#include <cstddef>
#include <vector>

namespace palpation {
namespace {

using Handle = OpenMesh::HalfedgeHandle;

/// The corner of a face from which the edge runs from start to end.
int corner_of_edge(const Triangles& triangles, int face, int start, int end) {
  for (int i = 0; i < 2; ++i) {
    if (triangles(face, i) == start && triangles(face, i + 1) == end) return i;
  }
  return 2;
}

/// One half-edge for each corner of each triangle, in a row; their partners are their opposites, or
/// lie outside the tissue.
std::vector<Handle> add_edges(HalfEdgeMesh& mesh, const Triangles& triangles,
                              const Triangles& neighbours) {
  std::vector<Handle> inside(static_cast<std::size_t>(triangles.size()));
  for (int f = 0; f < triangles.rows(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const int across = neighbours(f, i);
      if (across >= 0 && across < f) continue;  // made from there
      const int start = triangles(f, i), end = triangles(f, (i + 1) % 3);
      const Handle half_edge =
          mesh.new_edge(OpenMesh::VertexHandle(start), OpenMesh::VertexHandle(end));
      inside[3 * f + i] = half_edge;
      if (across >= 0)
        inside[3 * across + corner_of_edge(triangles, across, end, start)] =
            mesh.opposite_halfedge_handle(half_edge);
    }
  }
  return inside;
}

void add_faces(HalfEdgeMesh& mesh, const Triangles& triangles, const std::vector<Handle>& inside) {
  for (int f = 0; f < triangles.rows(); ++f) {
    const OpenMesh::FaceHandle face = mesh.new_face();
    mesh.set_halfedge_handle(face, inside[3 * f]);
    for (int i = 0; i < 3; ++i) {
      mesh.set_face_handle(inside[3 * f + i], face);
      mesh.set_next_halfedge_handle(inside[3 * f + i], inside[3 * f + (i + 1) % 3]);
      mesh.set_halfedge_handle(OpenMesh::VertexHandle(triangles(f, i)), inside[3 * f + i]);
    }
  }
}

/// The half-edges outside: each border vertex has one that leaves it, by which OpenMesh knows a
/// border vertex.
void join_borders(HalfEdgeMesh& mesh, const std::vector<Handle>& inside) {
  std::vector<Handle> outside;
  for (const Handle half_edge : inside) {
    const Handle opposite = mesh.opposite_halfedge_handle(half_edge);
    if (!mesh.is_boundary(opposite)) continue;
    outside.push_back(opposite);
    mesh.set_halfedge_handle(mesh.from_vertex_handle(opposite), opposite);
  }
  for (const Handle half_edge : outside)
    mesh.set_next_halfedge_handle(half_edge,
                                  mesh.halfedge_handle(mesh.to_vertex_handle(half_edge)));
}

}  // namespace

HalfEdgeMesh make_half_edge_mesh(const TriangleMesh& mesh, const Triangles& neighbours) {
  const auto vertex_count = static_cast<std::size_t>(mesh.vertices.rows());
  const auto face_count = static_cast<std::size_t>(mesh.triangles.rows());
  HalfEdgeMesh half_edges;
  half_edges.reserve(vertex_count, vertex_count + face_count, face_count);
  for (const auto& x : mesh.vertices.rowwise())
    half_edges.add_vertex(OpenMesh::Vec3d(x[0], x[1], x[2]));
  const std::vector<Handle> inside = add_edges(half_edges, mesh.triangles, neighbours);
  add_faces(half_edges, mesh.triangles, inside);
  join_borders(half_edges, inside);
  return half_edges;
}

}  // namespace palpation
