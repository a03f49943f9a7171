#include "palpation/geometry/clearance.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "palpation/base/error.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

/// Rounding: a line that starts on a face meets it or not, but the faces around the start do not
/// count.
using Kernel = CGAL::Simple_cartesian<double>;
using Faces = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Faces::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 cgal_point(const Vec3& place) { return {place.x(), place.y(), place.z()}; }

/// Along the way of the tip's middle, always as far on as nothing can be in the way.
bool has_room(const Surface& surface, int vertex, double length_m, double radius_m) {
  constexpr double kTouching = 0.98;  // of the radius
  const Vec3 normal = surface.vertex_normals().row(vertex),
             start = surface.vertex(vertex) + radius_m * normal;
  for (double height = 0.0; height < length_m;) {
    const Vec3 middle = start + height * normal;
    const double room =
        (surface.position(surface.project(middle)) - middle).norm() - kTouching * radius_m;
    if (room <= 0.0) return false;
    height += std::max(room, 0.01 * radius_m);
  }
  return true;
}

}  // namespace

std::vector<bool> clear_vertices(const Surface& surface, double length_m, double radius_m) {
  require(std::isfinite(length_m) && length_m > 0.0, "clear_vertices",
          "length_m = " + text_of(length_m), "must be positive and finite");
  require(std::isfinite(radius_m) && radius_m >= 0.0, "clear_vertices",
          "radius_m = " + text_of(radius_m), "must be finite and not negative");
  surface.note_computed("clearance");
  Faces faces;
  for (int face = 0; face < surface.face_count(); ++face) {
    const Eigen::Vector3i corners = surface.triangle(face);
    faces.emplace_back(cgal_point(surface.vertex(corners[0])),
                       cgal_point(surface.vertex(corners[1])),
                       cgal_point(surface.vertex(corners[2])));
  }
  const Tree tree(faces.cbegin(), faces.cend());
  const Points& normals = surface.vertex_normals();
  std::vector<bool> clear(static_cast<std::size_t>(surface.vertex_count()));
  std::vector<char> room(clear.size());  // not bits: threads write beside each other
  std::vector<Faces::const_iterator> met;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    const Vec3 start = surface.vertex(vertex),
               end = start + length_m * normals.row(vertex).transpose();
    const Kernel::Segment_3 line(cgal_point(start), cgal_point(end));
    met.clear();
    if (!line.is_degenerate()) tree.all_intersected_primitives(line, std::back_inserter(met));
    clear[vertex] = std::all_of(met.begin(), met.end(), [&](Faces::const_iterator face) {
      return (surface.triangle(static_cast<int>(face - faces.cbegin())).array() == vertex).any();
    });
  }
  if (radius_m == 0.0) return clear;
  for_ranges(surface.vertex_count(), 256, [&](int first, int last) {
    for (int vertex = first; vertex < last; ++vertex)
      room[vertex] = has_room(surface, vertex, length_m, radius_m);
  });
  for (std::size_t vertex = 0; vertex < clear.size(); ++vertex)
    clear[vertex] = clear[vertex] && room[vertex];
  return clear;
}

}  // namespace palpation
