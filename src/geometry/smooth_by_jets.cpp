// CGAL takes its linear algebra from Eigen where this is set.
#define CGAL_EIGEN3_ENABLED 1
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/jet_smooth_point_set.h>

#include <vector>

#include "geometry/triangulate.h"

namespace palpation {

Points smooth_by_jets(const Points& points, int neighbours) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> places;
  for (const auto& point : points.rowwise()) places.emplace_back(point.x(), point.y(), point.z());
  CGAL::jet_smooth_point_set<CGAL::Sequential_tag>(places, static_cast<unsigned>(neighbours));
  Points smooth(points.rows(), 3);
  for (std::size_t i = 0; i < places.size(); ++i)
    smooth.row(static_cast<Eigen::Index>(i)) << places[i].x(), places[i].y(), places[i].z();
  return smooth;
}

}  // namespace palpation
