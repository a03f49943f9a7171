#include "geometry/neighbours.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/property_map.h>

namespace palpation {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PlaceOf = CGAL::Pointer_property_map<Kernel::Point_3>::const_type;
using Traits = CGAL::Search_traits_adapter<std::size_t, PlaceOf, CGAL::Search_traits_3<Kernel>>;
using Search = CGAL::Orthogonal_k_neighbor_search<Traits>;

}  // namespace

std::vector<std::vector<int>> nearest_others(const Points& points, int count) {
  std::vector<Kernel::Point_3> places;
  std::vector<std::size_t> numbers;
  for (const auto& point : points.rowwise()) {
    numbers.push_back(places.size());
    places.emplace_back(point.x(), point.y(), point.z());
  }
  const PlaceOf place_of(places.data());
  const Traits traits(place_of);
  Search::Tree tree(numbers.begin(), numbers.end(), Search::Splitter(), traits);
  const Search::Distance distance(place_of);
  std::vector<std::vector<int>> result(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Search search(tree, places[i], static_cast<unsigned>(count) + 1, 0.0, true, distance);
    for (const auto& [number, square] : search) {
      if (number != i && result[i].size() < static_cast<std::size_t>(count))
        result[i].push_back(static_cast<int>(number));
    }
  }
  return result;
}

}  // namespace palpation
