/// Polygons with holes as Python's lists, arrays and geo-interfaces.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "palpation/boundary/region.h"

namespace palpation::python {

/// From a list of pairs (outer, holes). Throws as arrays.h says, TypeError for what is no such
/// list.
std::vector<PolygonWithHoles> polygons_from_list(const pybind11::list& polygons);
/// From what has a __geo_interface__, or such a dictionary. Throws InvalidInput unless it is a
/// Polygon or a MultiPolygon in two dimensions.
std::vector<PolygonWithHoles> polygons_from_shape(const pybind11::object& shape);

pybind11::list polygons_to_list(const Region& region);
/// {"type": "MultiPolygon", "coordinates": ...}, rings closed.
pybind11::dict geo_interface(const Region& region);

/// A region, and what was tidied away: sentences. Throws as Region, in the function's name.
struct Outlined {
  Region region;
  std::vector<std::string> warnings;
};
Outlined outlined(const std::vector<PolygonWithHoles>& polygons, const std::string& function);

}  // namespace palpation::python
