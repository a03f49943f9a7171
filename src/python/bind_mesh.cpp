#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "io/length_scale.h"
#include "palpation/base/error.h"
#include "palpation/base/random.h"
#include "palpation/geometry/make_phantom.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/io/read_mesh.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/long_call.h"
#include "python/mesh_of.h"

namespace py = pybind11;
using namespace py::literals;

namespace palpation::python {
namespace {

py::tuple warnings_of(const MeshFile& file) {
  py::list sentences;
  for (const MeshWarning& warning : file.warnings)
    sentences.append(warning.text + " " + warning.advice);
  return py::tuple(sentences);
}

struct RepairWord {
  const char* word;
  bool MeshRepair::*asked;
};
constexpr std::array<RepairWord, 5> kRepairs{{{"weld", &MeshRepair::weld_equal_vertices},
                                              {"triangulate", &MeshRepair::cut_polygons},
                                              {"drop-duplicates", &MeshRepair::drop_duplicates},
                                              {"drop-degenerate", &MeshRepair::drop_flat},
                                              {"largest", &MeshRepair::keep_largest}}};

MeshRepair repair_of(const std::vector<std::string>& words, bool weld) {
  MeshRepair repair{.weld_equal_vertices = weld};
  for (const std::string& word : words) {
    const auto known = std::ranges::find(kRepairs, word, &RepairWord::word);
    require(known != kRepairs.end(), "read_mesh", "repair '" + word + "'",
            "must be 'weld', 'triangulate', 'drop-duplicates', 'drop-degenerate' or 'largest'");
    repair.*known->asked = true;
  }
  return repair;
}

MeshFile made(TriangleMesh mesh) {
  MeshFile file;
  file.mesh = std::move(mesh);
  file.format = "made";
  return file;
}

MeshFile plane(py::handle size_m, int columns, int rows, py::handle corner_m, double jitter,
               std::uint64_t seed) {
  PlaneOptions options;
  options.size_m = pair_of(size_m, {"make_plane", "size_m"});
  options.columns = columns;
  options.rows = rows;
  options.corner_m = pair_of(corner_m, {"make_plane", "corner_m"});
  options.jitter = jitter;
  return long_call([&] {
    Random random(seed);
    return made(make_plane(options, random));
  });
}

MeshFile mesh_of(const Sheet& sheet, double edge_m, double jitter, std::uint64_t seed) {
  return long_call([&] {
    Random random(seed);
    return made(make_phantom(sheet, edge_m, jitter, random).mesh);
  });
}

/// A rectangle that is bent to one radius.
template <typename Options>
void bind_bent(py::module_& module, const char* name, Sheet (*sheet_of)(const Options&),
               const char* what) {
  const Options usual;
  module.def(
      name,
      [name, sheet_of](double radius_m, py::handle size_m, double edge_m, double jitter,
                       std::uint64_t seed) {
        const Options options{radius_m, pair_of(size_m, {name, "size_m"})};
        return mesh_of(sheet_of(options), edge_m, jitter, seed);
      },
      py::kw_only(), "radius_m"_a = usual.radius_m,
      "size_m"_a = py::make_tuple(usual.size_m.x(), usual.size_m.y()), "edge_m"_a = 0.0005,
      "jitter"_a = 0.3, "seed"_a = 1, what);
}

void bind_generators(py::module_& module) {
  module.def("make_plane", &plane, py::kw_only(), "size_m"_a = py::make_tuple(0.025, 0.050),
             "columns"_a = 200, "rows"_a = 200, "corner_m"_a = py::make_tuple(0.0, 0.0),
             "jitter"_a = 0.0, "seed"_a = 1,
             "A rectangle in the plane z = 0, columns x rows vertices.");
  bind_bent<CylinderOptions>(
      module, "make_cylinder", &cylinder_sheet,
      "A part of a cylinder about an axis along y; size along the arc and along the axis.");
  module.def(
      "make_dome",
      [](double radius_m, double reach_m, double edge_m, double jitter, std::uint64_t seed) {
        return mesh_of(dome_sheet({radius_m, reach_m}), edge_m, jitter, seed);
      },
      py::kw_only(), "radius_m"_a = 0.025, "reach_m"_a = 0.0205, "edge_m"_a = 0.0005,
      "jitter"_a = 0.3, "seed"_a = 1,
      "A spherical cap with its top at the origin: all within reach_m of it along the surface.");
  bind_bent<SaddleOptions>(module, "make_saddle", &saddle_sheet,
                           "z = (x^2 - y^2) / (2 radius_m) over a rectangle around the origin.");
  module.def(
      "make_wave",
      [](double amplitude_m, double wavelength_m, py::handle size_m, double edge_m, double jitter,
         std::uint64_t seed) {
        const WaveOptions options{amplitude_m, wavelength_m,
                                  pair_of(size_m, {"make_wave", "size_m"})};
        return mesh_of(wave_sheet(options), edge_m, jitter, seed);
      },
      py::kw_only(), "amplitude_m"_a = 0.002, "wavelength_m"_a = 0.020,
      "size_m"_a = py::make_tuple(0.025, 0.050), "edge_m"_a = 0.0005, "jitter"_a = 0.3,
      "seed"_a = 1, "z = amplitude_m sin(2 pi y / wavelength_m) over a rectangle.");
  module.def(
      "make_folded",
      [](double gap_m, double flank_m, double width_m, double edge_m, double jitter,
         std::uint64_t seed) {
        return mesh_of(folded_sheet({gap_m, flank_m, width_m}), edge_m, jitter, seed);
      },
      py::kw_only(), "gap_m"_a = 0.0015, "flank_m"_a = 0.020, "width_m"_a = 0.025,
      "edge_m"_a = 0.0005, "jitter"_a = 0.3, "seed"_a = 1,
      "An S-bend: three flat flanks one above the other, joined by half circles.");
}

}  // namespace

TriangleMesh mesh_from(py::handle vertices, py::handle faces, const std::string& unit,
                       const char* function) {
  const LengthUnit length = length_unit(unit);
  TriangleMesh mesh{points_of(vertices, {function, "vertices"}),
                    triangles_of(faces, {function, "faces"})};
  mesh.vertices = mesh.vertices.unaryExpr([length](double x) { return to_metres(x, length); });
  return mesh;
}

void bind_mesh(py::module_& module) {
  py::class_<MeshFile>(module, "Mesh",
                       "Plain triangles in metres, as a file holds them or a generator makes "
                       "them; `surface()` checks them.")
      .def_property_readonly(
          "vertices",
          [](py::object self) { return view_of(self.cast<MeshFile&>().mesh.vertices, self); },
          "n x 3, metres, read-only.")
      .def_property_readonly(
          "faces",
          [](py::object self) { return view_of(self.cast<MeshFile&>().mesh.triangles, self); },
          "m x 3, counter-clockwise seen from outside, read-only.")
      .def_property_readonly("warnings", &warnings_of, "What was repaired or looks odd: sentences.")
      .def_readonly("format", &MeshFile::format, "What the file was: 'binary PLY', ...; or 'made'.")
      .def_property_readonly(
          "height_sd_m",
          [](py::object self) -> py::object {
            const Field& height_sd = self.cast<MeshFile&>().height_sd;
            if (height_sd.size() == 0) return py::none();
            return view_of(height_sd, self);
          },
          "How sure each vertex' height is, metres, where a PLY says so; else None.")
      .def(
          "surface",
          [](const MeshFile& file) { return long_call([&] { return Surface(file.mesh); }); },
          "The tissue surface of it. Raises InvalidMesh, naming the element and the rule.")
      .def("__repr__", [](const MeshFile& file) {
        return "<palpation.Mesh: " + std::to_string(file.mesh.vertices.rows()) + " vertices, " +
               std::to_string(file.mesh.triangles.rows()) + " faces, " + file.format + ">";
      });
  module.def(
      "read_mesh",
      [](const std::filesystem::path& path, const std::string& unit, bool weld,
         const std::vector<std::string>& repair) {
        const MeshRepair asked = repair_of(repair, weld);
        return long_call([&] { return read_mesh(path, length_unit(unit), asked); });
      },
      "path"_a, "unit"_a, py::kw_only(), "weld"_a = false, "repair"_a = std::vector<std::string>(),
      "OBJ, OFF, STL, PLY or VTP, recognized by content; unit: 'mm', 'cm' or 'm'. repair: what is "
      "mended only on request, as by `palpate mesh repair`: 'weld' (or weld=True: vertices at "
      "equal places become one), 'triangulate' (polygons that no corner sees as a whole are cut, "
      "too), "
      "'drop-duplicates' (of triangles with the same corners the first is kept), 'drop-degenerate' "
      "(what has no area goes, and leaves no crack), 'largest' (the component of the largest area "
      "is kept). What was done is in the mesh's warnings, each with its count and its first place. "
      "Raises IoError with path, line or byte and rule.");
  module.def(
      "write_mesh",
      [](const std::filesystem::path& path, py::handle vertices, py::handle faces,
         const std::string& unit) {
        const TriangleMesh mesh = mesh_from(vertices, faces, "m", "write_mesh");
        long_call([&] {
          write_mesh(path, mesh, length_unit(unit));
          return true;
        });
      },
      "path"_a, "vertices"_a, "faces"_a, "unit"_a,
      "Writes vertices in metres as PLY, OBJ, OFF or STL, by the path's extension, in the unit.");
  bind_generators(module);
}

}  // namespace palpation::python
