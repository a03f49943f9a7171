/// A mesh as CGAL's algorithms want it; only for sources that use CGAL anyway.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<CgalKernel::Point_3>;

inline CgalMesh copy_of(const TriangleMesh& mesh) {
  CgalMesh copy;
  for (const auto& vertex : mesh.vertices.rowwise())
    copy.add_vertex(CgalKernel::Point_3(vertex.x(), vertex.y(), vertex.z()));
  for (const auto& corner : mesh.triangles.rowwise()) {
    const auto index = [&](int i) {
      return CgalMesh::Vertex_index(static_cast<CgalMesh::size_type>(corner[i]));
    };
    copy.add_face(index(0), index(1), index(2));
  }
  return copy;
}

}  // namespace palpation
