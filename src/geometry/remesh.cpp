#include <CGAL/Polygon_mesh_processing/remesh.h>

#include "geometry/cgal_mesh.h"
#include "geometry/triangulate.h"

namespace palpation {
namespace {

constexpr unsigned kRounds = 5;

}  // namespace

TriangleMesh remesh(const TriangleMesh& mesh, double edge_m) {
  namespace PMP = CGAL::Polygon_mesh_processing;
  CgalMesh copy = copy_of(mesh);
  PMP::isotropic_remeshing(copy.faces(), edge_m, copy,
                           PMP::parameters::number_of_iterations(kRounds));
  copy.collect_garbage();
  TriangleMesh result{Points(static_cast<Eigen::Index>(copy.number_of_vertices()), 3),
                      Triangles(static_cast<Eigen::Index>(copy.number_of_faces()), 3)};
  for (const CgalMesh::Vertex_index vertex : copy.vertices()) {
    const CgalKernel::Point_3& point = copy.point(vertex);
    result.vertices.row(static_cast<Eigen::Index>(vertex.idx())) << point.x(), point.y(), point.z();
  }
  for (const CgalMesh::Face_index face : copy.faces()) {
    int corner = 0;
    for (const CgalMesh::Vertex_index vertex : copy.vertices_around_face(copy.halfedge(face)))
      result.triangles(static_cast<Eigen::Index>(face.idx()), corner++) =
          static_cast<int>(vertex.idx());
  }
  return result;
}

}  // namespace palpation
