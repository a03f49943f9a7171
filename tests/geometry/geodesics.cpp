#include "geometry/geodesics.h"

#include <CGAL/Surface_mesh_shortest_path.h>

#include <array>
#include <limits>
#include <string>

#include "geometry/cgal_mesh.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

using ShortestPaths =
    CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<CgalKernel, CgalMesh>>;

/// CGAL counts corners from the target of the face's own half-edge, wherever that is.
ShortestPaths::Barycentric_coordinates cgal_weights(const CgalMesh& copy, const TriangleMesh& mesh,
                                                    const SurfacePoint& point) {
  std::array<double, 3> weights{};
  const CgalMesh::Face_index face(static_cast<CgalMesh::size_type>(point.face));
  CgalMesh::Halfedge_index half_edge = copy.halfedge(face);
  for (int k = 0; k < 3; ++k, half_edge = copy.next(half_edge)) {
    const auto start = static_cast<int>(copy.source(half_edge).idx());
    for (int i = 0; i < 3; ++i) {
      if (mesh.triangles(point.face, i) == start) weights[k] = point.barycentric[i];
    }
  }
  return {weights[0], weights[1], weights[2]};
}

Field distances_to_all(const TriangleMesh& mesh, std::span<const SurfacePoint> sources) {
  const CgalMesh copy = copy_of(mesh);
  ShortestPaths paths(copy);
  for (const SurfacePoint& source : sources) {
    const CgalMesh::Face_index face(static_cast<CgalMesh::size_type>(source.face));
    paths.add_source_point(face, cgal_weights(copy, mesh, source));
  }
  paths.build_sequence_tree();
  Field distances(mesh.vertices.rows());
  for (const CgalMesh::Vertex_index vertex : copy.vertices()) {
    const double distance = paths.shortest_distance_to_source_points(vertex).first;
    distances[vertex.idx()] =
        distance < 0.0 ? std::numeric_limits<double>::infinity() : distance;  // below 0: no path
  }
  return distances;
}

}  // namespace

Field unfold_distances(const TriangleMesh& mesh, std::span<const SurfacePoint> sources) {
  try {
    return distances_to_all(mesh, sources);
  } catch (const CGAL::Failure_exception& failure) {
    throw NumericalError("unfold_distances: unfolding the faces failed: " + failure.message() +
                         " (" + failure.expression() + ")");
  }
}

}  // namespace palpation
