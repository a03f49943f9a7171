#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "geometry/triangulate.h"

namespace palpation {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;  // the point's number
using Delaunay =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase>>;

}  // namespace

Triangles triangulate_along(const Points& points, const Vec3& direction) {
  const Vec3 normal = direction.normalized();
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 v = normal.cross(u);
  std::vector<std::pair<Delaunay::Point, int>> places;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    places.emplace_back(Delaunay::Point(points.row(i).dot(u), points.row(i).dot(v)),
                        static_cast<int>(i));
  const Delaunay delaunay(places.begin(), places.end());
  Triangles triangles(static_cast<Eigen::Index>(delaunay.number_of_faces()), 3);
  Eigen::Index count = 0;
  if (delaunay.dimension() < 2) return {};
  for (const Delaunay::Face_handle face : delaunay.finite_face_handles()) {
    for (int i = 0; i < 3; ++i) triangles(count, i) = face->vertex(i)->info();
    ++count;
  }
  return triangles;
}

}  // namespace palpation
