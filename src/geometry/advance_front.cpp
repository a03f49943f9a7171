#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <iterator>
#include <vector>

#include "geometry/triangulate.h"

namespace palpation {

Triangles advance_front(const Points& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> places;
  for (const auto& point : points.rowwise()) places.emplace_back(point.x(), point.y(), point.z());
  std::vector<std::array<std::size_t, 3>> facets;
  CGAL::advancing_front_surface_reconstruction(places.begin(), places.end(),
                                               std::back_inserter(facets));
  Triangles triangles(static_cast<Eigen::Index>(facets.size()), 3);
  for (std::size_t i = 0; i < facets.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      triangles(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          static_cast<int>(facets[i][k]);
  }
  return triangles;
}

}  // namespace palpation
