#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "palpation/base/error.h"
#include "palpation/boundary/level_set.h"
#include "palpation/boundary/region.h"
#include "palpation/boundary/region_error.h"
#include "palpation/io/wkt.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/long_call.h"
#include "python/polygons.h"
#include "python/warn.h"

namespace py = pybind11;
using namespace py::literals;

namespace palpation::python {
namespace {

using RegionClass = py::class_<Region>;

/// What is wrong with a text is the caller's fault, no file's.
Region region_from_wkt(const std::string& text) {
  const BoundaryFile file = long_call([&] {
    try {
      return parse_wkt(text, "Region.from_wkt");
    } catch (const IoError& error) {
      throw InvalidInput(error.what());
    }
  });
  warn(file.warnings);
  return file.region;
}

Region region_of(const std::vector<PolygonWithHoles>& polygons, const std::string& function) {
  const Outlined made = long_call([&] { return outlined(polygons, function); });
  warn(made.warnings);
  return made.region;
}

py::array contains(const Region& region, py::handle places) {
  const Points2 uv = places_of(places, {"Region.contains", "places"});
  py::array_t<bool> inside(uv.rows());
  for (Eigen::Index row = 0; row < uv.rows(); ++row)
    inside.mutable_at(row) = region.contains(uv.row(row).transpose());
  return inside;
}

using Operation = Region (*)(const Region&, const Region&);

template <Operation operation>
Region operated(const Region& a, const Region& b) {
  return long_call([&] { return operation(a, b); });
}

py::dict error_dict(const RegionError& error) {
  const auto maybe = [](const std::optional<double>& value) {
    return value ? py::object(py::float_(*value)) : py::object(py::none());
  };
  return py::dict("missed_m2"_a = error.missed_m2, "extra_m2"_a = error.extra_m2,
                  "symmetric_difference_m2"_a = error.symmetric_difference_m2,
                  "dice"_a = error.dice, "hausdorff_m"_a = maybe(error.hausdorff_m),
                  "mean_distance_m"_a = maybe(error.mean_distance_m));
}

void bind_makers(RegionClass& region) {
  region.def(py::init<>(), "Nothing.")
      .def(py::init([](const py::list& polygons) {
             return region_of(polygons_from_list(polygons), "Region");
           }),
           "polygons"_a,
           "The union of polygons, each a pair (outer, holes): outer n x 2, holes a list of such, "
           "metres in a chart. What is tidied away is a UserWarning. Raises InvalidInput where a "
           "ring crosses itself.")
      .def_static("from_wkt", &region_from_wkt, "text"_a,
                  "From POLYGON or MULTIPOLYGON, metres in a chart. Raises InvalidInput with the "
                  "byte.")
      .def_static(
          "from_shape",
          [](const py::object& shape) {
            return region_of(polygons_from_shape(shape), "Region.from_shape");
          },
          "shape"_a,
          "From what has a __geo_interface__ (shapely's polygons, a Region), or such a dictionary: "
          "Polygon or MultiPolygon.")
      .def(py::pickle([](const Region& here) { return py::make_tuple(to_wkt(here)); },
                      [](const py::tuple& state) {
                        return parse_wkt(state[0].cast<std::string>(), "Region").region;
                      }));
}

void bind_operators(RegionClass& region) {
  region.def("__or__", &operated<unite>, py::is_operator(), "Union.")
      .def("__and__", &operated<intersect>, py::is_operator(), "What both have.")
      .def("__sub__", &operated<subtract>, py::is_operator(), "What the other does not have.")
      .def("__xor__", &operated<symmetric_difference>, py::is_operator(),
           "What only one of them has.")
      .def("__bool__", [](const Region& here) { return !here.empty(); })
      .def("__repr__", [](const Region& here) {
        return "<palpation.Region: " + std::to_string(here.polygons().size()) + " polygons, " +
               text_of(here.area()) + " m2>";
      });
}

}  // namespace

void bind_region(py::module_& module) {
  RegionClass region(module, "Region",
                     "A part of the tissue: polygons with holes in the coordinates of a chart, "
                     "metres. Exact and immutable. a | b, a & b, a - b, a ^ b.");
  bind_makers(region);
  bind_operators(region);
  region.def_property_readonly("area_m2", &Region::area, "In the chart.")
      .def_property_readonly("polygons", &polygons_to_list,
                             "A list of (outer, holes): n x 2 arrays, outer rings "
                             "counter-clockwise, holes clockwise, no first point repeated.")
      .def_property_readonly("wkt", &to_wkt, "MULTIPOLYGON, as boundary.wkt has it.")
      .def_property_readonly("__geo_interface__", &geo_interface,
                             "A MultiPolygon: shapely.geometry.shape(region) takes it.")
      .def("contains", &contains, "places"_a,
           "For each of n x 2 places of the chart whether it is inside; the border counts.");
  module.def(
      "superlevel_region",
      [](const Surface& surface, py::handle field, double level) {
        const Field values =
            numbers_of(field, {"superlevel_region", "field"}, surface.vertex_count());
        return long_call([&] { return superlevel_region(surface, values, level); });
      },
      "surface"_a, "field"_a, "level"_a,
      "Where a field, one value a vertex, is at least the level: a region of the chart.");
  module.def(
      "surface_area",
      [](const Surface& surface, const Region& part) {
        return long_call([&] { return surface_area(surface, part); });
      },
      "surface"_a, "region"_a, "The area of a region on the tissue, m2.");
  module.def(
      "compare",
      [](const Surface& surface, const Region& estimate, const Region& truth) {
        return error_dict(long_call([&] { return compare(surface, estimate, truth); }));
      },
      "surface"_a, "estimate"_a, "truth"_a,
      "How wrong an estimate is: missed, extra and their sum in m2 on the tissue, dice, "
      "distances.");
}

}  // namespace palpation::python
