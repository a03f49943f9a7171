#include "geometry/coarsen.h"

#include <Eigen/Geometry>
#include <cmath>
#include <queue>
#include <tuple>

#include "geometry/half_edge_mesh.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

using HalfEdge = OpenMesh::HalfedgeHandle;
using Vertex = OpenMesh::VertexHandle;

constexpr double kLongest = 1.5;  // edges that are made, over the length asked for
constexpr double kLeastCosine =
    0.94;  // of 20 degrees: between a new face and the tissue at its corners
constexpr double kLeastQuality =
    0.25;  // of a new face: 1 where it is equilateral, 0 where it is a line
constexpr double kStraightBorder = 0.05;  // how far the border may move, over the length asked for

/// Twice the area over the squared sides' sum, 1 for equilateral triangles.
double quality(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return 2.0 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / squares;
}

Triangles neighbours_of(const Surface& surface) {
  Triangles neighbours(surface.face_count(), 3);
  for (int face = 0; face < surface.face_count(); ++face) {
    for (int corner = 0; corner < 3; ++corner)
      neighbours(face, corner) = surface.neighbour(face, corner);
  }
  return neighbours;
}

class Collapses {
 public:
  Collapses(const Surface& surface, double edge_m)
      : surface_(surface),
        mesh_(make_half_edge_mesh(surface.mesh(), neighbours_of(surface))),
        edge_m_(edge_m) {
    mesh_.request_vertex_status();
    mesh_.request_edge_status();
    mesh_.request_halfedge_status();
    mesh_.request_face_status();
    for (const HalfEdge half_edge : mesh_.halfedges()) offer(half_edge);
  }

  void run() {
    while (!offers_.empty()) {
      const auto [length, number, from, to] = offers_.top();
      offers_.pop();
      const HalfEdge half_edge(number);
      const bool is_stale = mesh_.status(half_edge).deleted() ||
                            mesh_.from_vertex_handle(half_edge).idx() != from ||
                            mesh_.to_vertex_handle(half_edge).idx() != to;
      if (is_stale || !keeps_border(half_edge) || !keeps_faces(half_edge) ||
          !mesh_.is_collapse_ok(half_edge))
        continue;
      const Vertex kept = mesh_.to_vertex_handle(half_edge);
      mesh_.collapse(half_edge);
      for (const HalfEdge around : mesh_.voh_range(kept)) {
        offer(around);
        offer(mesh_.opposite_halfedge_handle(around));
      }
    }
  }

  CoarseMesh result() const {
    CoarseMesh coarse;
    std::vector<int> number(static_cast<std::size_t>(surface_.vertex_count()), -1);
    for (int vertex = 0; vertex < surface_.vertex_count(); ++vertex) {
      if (mesh_.status(Vertex(vertex)).deleted()) continue;
      number[vertex] = static_cast<int>(coarse.vertices.size());
      coarse.vertices.push_back(vertex);
    }
    std::vector<Eigen::Vector3i> triangles;
    for (const auto face : mesh_.all_faces()) {
      if (mesh_.status(face).deleted()) continue;
      Eigen::Vector3i corners;
      int corner = 0;
      for (const Vertex vertex : mesh_.fv_range(face)) corners[corner++] = number[vertex.idx()];
      triangles.push_back(corners);
    }
    coarse.mesh.vertices.resize(static_cast<Eigen::Index>(coarse.vertices.size()), 3);
    for (std::size_t i = 0; i < coarse.vertices.size(); ++i)
      coarse.mesh.vertices.row(i) = surface_.vertex(coarse.vertices[i]);
    coarse.mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
    for (std::size_t i = 0; i < triangles.size(); ++i) coarse.mesh.triangles.row(i) = triangles[i];
    return coarse;
  }

 private:
  Vec3 at(Vertex vertex) const { return surface_.vertex(vertex.idx()); }

  void offer(HalfEdge half_edge) {
    const Vertex from = mesh_.from_vertex_handle(half_edge), to = mesh_.to_vertex_handle(half_edge);
    const double length = (at(to) - at(from)).norm();
    if (length < edge_m_) offers_.push({length, half_edge.idx(), from.idx(), to.idx()});
  }

  /// A vertex of the border goes only along it, and only where it is straight.
  bool keeps_border(HalfEdge half_edge) const {
    const Vertex gone = mesh_.from_vertex_handle(half_edge),
                 kept = mesh_.to_vertex_handle(half_edge);
    if (!mesh_.is_boundary(gone)) return true;
    if (!mesh_.is_boundary(mesh_.edge_handle(half_edge))) return false;
    const HalfEdge outside = mesh_.halfedge_handle(gone);  // leaves it along the border
    const Vertex after = mesh_.to_vertex_handle(outside),
                 before = mesh_.from_vertex_handle(mesh_.prev_halfedge_handle(outside));
    const Vertex other = after == kept ? before : after;
    const Vec3 along = at(kept) - at(other);
    const double length = along.norm();
    if (!(length > 0.0) || (at(gone) - at(other)).dot(along) <= 0.0 ||
        (at(gone) - at(kept)).dot(along) >= 0.0)
      return false;
    return (at(gone) - at(other)).cross(along).norm() <= kStraightBorder * edge_m_ * length;
  }

  /// The faces that change, with the vertex that is kept in place of the one that goes.
  bool keeps_faces(HalfEdge half_edge) const {
    const Vertex gone = mesh_.from_vertex_handle(half_edge),
                 kept = mesh_.to_vertex_handle(half_edge);
    for (const HalfEdge spoke : mesh_.voh_range(gone)) {
      const Vertex first = mesh_.to_vertex_handle(spoke);
      if (first != kept && (at(first) - at(kept)).norm() > kLongest * edge_m_) return false;
      if (mesh_.is_boundary(spoke)) continue;
      const Vertex second = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(spoke));
      if (first == kept || second == kept) continue;
      const Vec3 a = at(kept), b = at(first), c = at(second);
      if (quality(a, b, c) < kLeastQuality) return false;
      const Vec3 normal = (b - a).cross(c - a).normalized();
      for (const Vertex corner : {kept, first, second, gone}) {
        if (normal.dot(surface_.vertex_normals().row(corner.idx())) < kLeastCosine) return false;
      }
    }
    return true;
  }

  using Offer = std::tuple<double, int, int, int>;  // length, half-edge, its ends
  const Surface& surface_;
  HalfEdgeMesh mesh_;
  double edge_m_;
  std::priority_queue<Offer, std::vector<Offer>, std::greater<>> offers_;
};

}  // namespace

CoarseMesh coarsen(const Surface& surface, double edge_m) {
  require(std::isfinite(edge_m) && edge_m > 0.0, "coarsen", "edge_m = " + text_of(edge_m),
          "must be positive and finite");
  Collapses collapses(surface, edge_m);
  collapses.run();
  return collapses.result();
}

}  // namespace palpation
