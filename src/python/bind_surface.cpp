#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "palpation/geometry/chart_place.h"
#include "palpation/geometry/distance.h"
#include "palpation/geometry/surface.h"
#include "palpation/io/write_vtp.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/long_call.h"
#include "python/mesh_of.h"
#include "python/places_on.h"

namespace py = pybind11;
using namespace py::literals;

namespace palpation::python {
namespace {

using SurfaceClass = py::class_<Surface>;

py::dict topology_of(const Surface& surface) {
  const Topology topology = surface.topology();
  return py::dict("components"_a = topology.components, "borders"_a = topology.borders,
                  "euler"_a = topology.euler, "handles"_a = topology.handles,
                  "is_disk"_a = topology.is_disk(), "is_closed"_a = topology.is_closed(),
                  "is_planar"_a = surface.is_planar());
}

Points positions_of(const Surface& surface, const std::vector<SurfacePoint>& places) {
  Points positions(static_cast<Eigen::Index>(places.size()), 3);
  for (Eigen::Index row = 0; row < positions.rows(); ++row)
    positions.row(row) = surface.position(places[static_cast<std::size_t>(row)]).transpose();
  return positions;
}

py::array closest_points(const Surface& surface, py::handle positions) {
  const Points given = points_of(positions, {"Surface.project", "positions"});
  return array_of(long_call([&] {
    std::vector<SurfacePoint> places;
    for (Eigen::Index row = 0; row < given.rows(); ++row)
      places.push_back(surface.project(given.row(row).transpose()));
    return positions_of(surface, places);
  }));
}

py::array charted(const Surface& surface, py::handle where) {
  const std::vector<SurfacePoint> places = places_on(surface, where, {"Surface.to_chart", "where"});
  return array_of(long_call([&] {
    Points2 uv(static_cast<Eigen::Index>(places.size()), 2);
    for (Eigen::Index row = 0; row < uv.rows(); ++row)
      uv.row(row) = chart_place(surface, places[static_cast<std::size_t>(row)]).transpose();
    return uv;
  }));
}

py::array distances(const Surface& surface, py::handle where) {
  const std::vector<SurfacePoint> places =
      places_on(surface, where, {"Surface.distance_from", "where"});
  return array_of(long_call([&] { return distance_from(surface, places); }));
}

void write_fields(const Surface& surface, const std::filesystem::path& path,
                  const py::dict& fields) {
  std::vector<std::pair<std::string, Field>> named;
  for (const auto& [name, values] : fields) {
    const std::string text = py::str(name).cast<std::string>();
    named.emplace_back(
        text, numbers_of(values, {"Surface.write_vtp", text.c_str()}, surface.vertex_count()));
  }
  long_call([&] {
    write_surface_vtp(path, surface, named);
    return true;
  });
}

void bind_what_it_is(SurfaceClass& surface) {
  surface
      .def_property_readonly(
          "vertices",
          [](py::object self) { return view_of(self.cast<Surface&>().mesh().vertices, self); },
          "n x 3, metres, read-only.")
      .def_property_readonly(
          "faces",
          [](py::object self) { return view_of(self.cast<Surface&>().mesh().triangles, self); },
          "m x 3, counter-clockwise seen from outside, read-only.")
      .def_property_readonly(
          "normals",
          [](py::object self) {
            const Surface& here = self.cast<Surface&>();
            return view_of(*long_call([&] { return &here.vertex_normals(); }), self);
          },
          "n x 3, of the vertices, unit, outward, read-only.")
      .def_property_readonly(
          "vertex_areas_m2",
          [](py::object self) {
            const Surface& here = self.cast<Surface&>();
            return view_of(*long_call([&] { return &here.vertex_areas(); }), self);
          },
          "A third of the faces around each vertex, m2, read-only.")
      .def_property_readonly(
          "chart",
          [](py::object self) {
            const Surface& here = self.cast<Surface&>();
            return view_of(long_call([&] { return &here.chart(); })->uv, self);
          },
          "n x 2: the tissue laid flat, metres, read-only. Raises InvalidInput where it cannot be.")
      .def_property_readonly("area_m2", &Surface::area)
      .def_property_readonly("diameter_m", &Surface::diameter, "Of the bounding box.")
      .def_property_readonly("has_chart", &Surface::has_chart, "Whether it can be laid flat.")
      .def_property_readonly("topology", &topology_of, "Components, borders, handles, ...")
      .def_property_readonly("border_loops", &Surface::border_loops,
                             "Lists of border vertices, the tissue on their left.")
      .def_property_readonly("computed", &Surface::computed,
                             "What has been computed so far beyond the mesh.");
}

}  // namespace

void bind_surface(py::module_& module) {
  SurfaceClass surface(module, "Surface",
                       "Tissue: an oriented, edge-manifold triangle mesh that has been checked. "
                       "Immutable; lengths are metres, whatever unit it was given in.");
  surface.def(
      py::init([](py::handle vertices, py::handle faces, const std::string& unit) {
        TriangleMesh mesh = mesh_from(vertices, faces, unit, "Surface");
        return long_call([&] { return Surface(std::move(mesh)); });
      }),
      "vertices"_a, "faces"_a, py::kw_only(), "unit"_a,
      "vertices: n x 3 in unit ('mm', 'cm' or 'm'). faces: m x 3, counter-clockwise seen from "
      "outside. Raises InvalidMesh, naming the element and the rule.");
  bind_what_it_is(surface);
  surface
      .def("project", &closest_points, "positions"_a,
           "The closest points of the surface to places of space, n x 3, metres.")
      .def("to_chart", &charted, "where"_a,
           "Vertices or positions on the tissue, laid flat: n x 2, metres.")
      .def("distance_from", &distances, "where"_a,
           "From every vertex along the surface to the nearest of these vertices or positions.")
      .def("write_vtp", &write_fields, "path"_a, "fields"_a,
           "For ParaView: the triangles with one array at the vertices for each field.")
      .def("__repr__", [](const Surface& here) {
        return "<palpation.Surface: " + std::to_string(here.vertex_count()) + " vertices, " +
               std::to_string(here.face_count()) + " faces>";
      });
  surface.def(py::pickle(
      [](const Surface& here) {
        return py::make_tuple(array_of(here.mesh().vertices), array_of(here.mesh().triangles));
      },
      [](const py::tuple& state) {
        return Surface(mesh_from(state[0], state[1], "m", "Surface"));
      }));
}

}  // namespace palpation::python
