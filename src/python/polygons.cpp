#include "python/polygons.h"

#include "boundary/outline_repairs.h"
#include "palpation/base/error.h"
#include "python/arrays.h"

namespace py = pybind11;
using namespace py::literals;

namespace palpation::python {
namespace {

Ring ring_of(py::handle given, const char* function) {
  const Points2 places = places_of(given, {function, "ring"});
  Ring ring;
  for (Eigen::Index row = 0; row < places.rows(); ++row)
    ring.emplace_back(places.row(row).transpose());
  return ring;
}

py::array array_of_ring(const Ring& ring) {
  Points2 places(static_cast<Eigen::Index>(ring.size()), 2);
  for (Eigen::Index row = 0; row < places.rows(); ++row)
    places.row(row) = ring[static_cast<std::size_t>(row)].transpose();
  return array_of(places);
}

/// Of a geo-interface, where the first place is given again at the end.
Ring closed_ring_of(py::handle given, const char* function) {
  Ring ring = ring_of(given, function);
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

/// The outer ring, then holes.
PolygonWithHoles polygon_of_rings(py::handle rings, const char* function) {
  PolygonWithHoles polygon;
  bool is_first = true;
  for (const py::handle ring : py::iter(rings)) {
    if (is_first)
      polygon.outer = closed_ring_of(ring, function);
    else
      polygon.holes.push_back(closed_ring_of(ring, function));
    is_first = false;
  }
  return polygon;
}

py::tuple closed_ring(const Ring& ring) {
  py::tuple places(ring.size() + 1);
  for (std::size_t i = 0; i <= ring.size(); ++i) {
    const Vec2& place = ring[i % ring.size()];
    places[i] = py::make_tuple(place.x(), place.y());
  }
  return places;
}

bool is_empty(py::handle coordinates) { return py::len(coordinates) == 0; }

}  // namespace

std::vector<PolygonWithHoles> polygons_from_list(const py::list& polygons) {
  std::vector<PolygonWithHoles> result;
  for (const py::handle given : polygons) {
    const bool is_pair = (py::isinstance<py::tuple>(given) || py::isinstance<py::list>(given)) &&
                         py::len(given) == 2;
    if (!is_pair)
      throw py::type_error("Region: polygons: a polygon is a pair (outer, holes), not " +
                           py::str(py::type::handle_of(given)).cast<std::string>());
    const auto pair = py::reinterpret_borrow<py::sequence>(given);
    PolygonWithHoles polygon{ring_of(pair[0], "Region"), {}};
    for (const py::handle hole : py::iter(pair[1]))
      polygon.holes.push_back(ring_of(hole, "Region"));
    result.push_back(std::move(polygon));
  }
  return result;
}

std::vector<PolygonWithHoles> polygons_from_shape(const py::object& shape) {
  constexpr const char* kFunction = "Region.from_shape";
  py::object geometry = shape;
  if (!py::isinstance<py::dict>(shape)) {
    if (!py::hasattr(shape, "__geo_interface__"))
      throw py::type_error(std::string(kFunction) + ": " +
                           py::str(py::type::handle_of(shape)).cast<std::string>() +
                           " has no __geo_interface__");
    geometry = shape.attr("__geo_interface__");
  }
  if (!py::isinstance<py::dict>(geometry) || !geometry.contains("type") ||
      !geometry.contains("coordinates"))
    throw InvalidInput(std::string(kFunction) + ": shape must have a type and coordinates");
  const std::string type = py::str(geometry["type"]).cast<std::string>();
  const py::object coordinates = geometry["coordinates"];
  std::vector<PolygonWithHoles> polygons;
  if (type == "Polygon") {
    if (!is_empty(coordinates)) polygons.push_back(polygon_of_rings(coordinates, kFunction));
  } else if (type == "MultiPolygon") {
    for (const py::handle rings : py::iter(coordinates)) {
      if (!is_empty(rings)) polygons.push_back(polygon_of_rings(rings, kFunction));
    }
  } else {
    throw InvalidInput(std::string(kFunction) + ": type " + type +
                       " must be Polygon or MultiPolygon");
  }
  return polygons;
}

py::list polygons_to_list(const Region& region) {
  py::list result;
  for (const PolygonWithHoles& polygon : region.polygons()) {
    py::list holes;
    for (const Ring& hole : polygon.holes) holes.append(array_of_ring(hole));
    result.append(py::make_tuple(array_of_ring(polygon.outer), holes));
  }
  return result;
}

py::dict geo_interface(const Region& region) {
  py::list polygons;
  for (const PolygonWithHoles& polygon : region.polygons()) {
    py::list rings;
    rings.append(closed_ring(polygon.outer));
    for (const Ring& hole : polygon.holes) rings.append(closed_ring(hole));
    polygons.append(py::tuple(rings));
  }
  return py::dict("type"_a = "MultiPolygon", "coordinates"_a = py::tuple(polygons));
}

Outlined outlined(const std::vector<PolygonWithHoles>& polygons, const std::string& function) {
  Outlined result{Region(polygons), repairs_of(polygons).words()};
  for (std::string& sentence : result.warnings) sentence = function + ": " + sentence;
  return result;
}

}  // namespace palpation::python
