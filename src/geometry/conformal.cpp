#include "geometry/conformal.h"

#define CGAL_EIGEN3_ENABLED 1  // its solver

#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <algorithm>

#include "geometry/cgal_mesh.h"

namespace palpation {
namespace {

double twice_area(const Triangles& triangles, const Points2& uv) {
  double twice = 0.0;
  for (const auto& t : triangles.rowwise()) {
    const Vec2 ab = uv.row(t[1]) - uv.row(t[0]), ac = uv.row(t[2]) - uv.row(t[0]);
    twice += ab.x() * ac.y() - ab.y() * ac.x();
  }
  return twice;
}

}  // namespace

std::optional<Points2> conformal_map(const TriangleMesh& mesh) try {
  namespace Parameterization = CGAL::Surface_mesh_parameterization;
  CgalMesh copy = copy_of(mesh);
  const auto edges = copy.halfedges();
  const auto border = *std::find_if(edges.begin(), edges.end(),
                                    [&](const auto& edge) { return copy.is_border(edge); });
  const auto places =
      copy.add_property_map<CgalMesh::Vertex_index, CgalKernel::Point_2>("v:uv").first;
  if (Parameterization::parameterize(copy, Parameterization::LSCM_parameterizer_3<CgalMesh>(),
                                     border, places) != Parameterization::OK)
    return std::nullopt;
  Points2 uv(mesh.vertices.rows(), 2);
  for (const CgalMesh::Vertex_index vertex : copy.vertices())
    uv.row(vertex.idx()) << places[vertex].x(), places[vertex].y();
  if (!uv.allFinite()) return std::nullopt;
  if (twice_area(mesh.triangles, uv) < 0.0) uv.col(1) *= -1.0;
  return uv;
} catch (const CGAL::Failure_exception&) {
  return std::nullopt;
}

}  // namespace palpation
