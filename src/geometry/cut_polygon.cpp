#include "geometry/cut_polygon.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace palpation {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corner = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;  // its number
using Marked = CGAL::Triangulation_face_base_with_info_2<bool, Kernel>;   // whether it is outside
using Face = CGAL::Constrained_triangulation_face_base_2<Kernel, Marked>;
using Cut = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<Corner, Face>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

/// Newell: twice the area that the polygon encloses as seen along each axis.
Vec3 vector_area(std::span<const Vec3> corners) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
  return sum;
}

/// As seen from where the polygon runs counter-clockwise.
CGAL::Polygon_2<Kernel> seen_along(std::span<const Vec3> corners, const Vec3& area) {
  Eigen::Index axis = 0;
  area.cwiseAbs().maxCoeff(&axis);
  Eigen::Index right = (axis + 1) % 3, up = (axis + 2) % 3;
  if (area[axis] < 0.0) std::swap(right, up);
  CGAL::Polygon_2<Kernel> outline;
  for (const Vec3& corner : corners) outline.push_back({corner[right], corner[up]});
  return outline;
}

/// Marks what is reached from infinity without crossing the polygon.
void mark_outside(Cut& cut) {
  for (const auto face : cut.all_face_handles()) face->info() = false;
  std::vector<Cut::Face_handle> reached = {cut.infinite_face()};
  reached.front()->info() = true;
  while (!reached.empty()) {
    const Cut::Face_handle face = reached.back();
    reached.pop_back();
    for (int side = 0; side < 3; ++side) {
      const Cut::Face_handle next = face->neighbor(side);
      if (next->info() || face->is_constrained(side)) continue;
      next->info() = true;
      reached.push_back(next);
    }
  }
}

}  // namespace

std::vector<std::array<int, 3>> cut_polygon(std::span<const Vec3> corners) {
  const Vec3 area = vector_area(corners);
  if (!area.allFinite() || area.isZero(0.0)) return {};
  const CGAL::Polygon_2<Kernel> outline = seen_along(corners, area);
  if (!outline.is_simple()) return {};
  Cut cut;
  std::vector<Cut::Vertex_handle> vertices;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    vertices.push_back(cut.insert(outline.vertex(i)));
    vertices.back()->info() = static_cast<int>(i);
  }
  for (std::size_t i = 0; i < vertices.size(); ++i)
    cut.insert_constraint(vertices[i], vertices[(i + 1) % vertices.size()]);
  mark_outside(cut);
  std::vector<std::array<int, 3>> triangles;
  for (const auto face : cut.finite_face_handles()) {
    if (face->info()) continue;
    std::array<int, 3> triangle = {face->vertex(0)->info(), face->vertex(1)->info(),
                                   face->vertex(2)->info()};
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                triangle.end());
    triangles.push_back(triangle);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace palpation
