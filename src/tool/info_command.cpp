// info: what a mesh is, or the tissue that a scene makes of one, what is wrong with it, and what to
// do.
#include <cstdio>
#include <optional>

#include "io/cannot_read.h"
#include "palpation/base/error.h"
#include "palpation/geometry/surface.h"
#include "palpation/io/read_mesh.h"
#include "scene/exit_code.h"
#include "scene/mesh_words.h"
#include "scene/scene.h"
#include "scene/tissue.h"
#include "tool/commands.h"

namespace palpation::tool {
namespace {

constexpr double kLeastExtent_m = 1e-3;
constexpr double kMostExtent_m = 2.0;
// Beyond, areas are no numbers, and counting faults would count that.
constexpr double kLeastCountable_m = 1e-60;
constexpr double kMostCountable_m = 1e60;

void print(const std::string& words) { std::fputs(words.c_str(), stdout); }

std::string counts_and_size(const TriangleMesh& mesh) {
  return std::to_string(mesh.vertices.rows()) + " vertices, " +
         std::to_string(mesh.triangles.rows()) + " triangles, " + size_words(mesh);
}

/// A file that is there but holds no mesh: what to do is the same whatever broke it.
MeshFile read(const InfoArguments& arguments, const MeshRepair& repair = {}) {
  try {
    return read_mesh_of_any_size(arguments.file, length_unit(arguments.unit), repair);
  } catch (const CannotRead&) {
    throw;
  } catch (const IoError& error) {
    throw IoError(
        std::string(error.what()) +
        "\n  Repair the file at that place (palpate help mesh repair), or export it again "
        "from the program that made it: PLY is the safest choice.");
  }
}

/// The surface, or why there is none.
struct Attempt {
  std::optional<Surface> surface;
  std::string reason;
};

Attempt attempt(const TriangleMesh& mesh) {
  try {
    return {Surface(mesh), ""};
  } catch (const InvalidMesh& error) {
    return {std::nullopt, error.what()};
  }
}

std::string kind_words(const Surface& surface) {
  const Topology topology = surface.topology();
  return "a surface of " + std::to_string(topology.components) +
         (topology.components == 1 ? " component" : " components") +
         (topology.is_closed() ? ", closed"
                               : " with " + std::to_string(topology.borders) +
                                     (topology.borders == 1 ? " border" : " borders"));
}

/// Tries what welding would do for a mesh with seams.
std::string weld_words(const InfoArguments& arguments) {
  try {
    const Attempt welded = attempt(read(arguments, {.weld_equal_vertices = true}).mesh);
    if (welded.surface)
      return "Welded, it is " + kind_words(*welded.surface) +
             ": set surface.weld to true in a scene.\n";
    return "Welding its vertices would not make it a surface: " + welded.reason + "\n";
  } catch (const IoError& error) {
    return "Welding its vertices would not make it a surface: " + std::string(error.what()) + "\n";
  }
}

bool is_plausible(double extent_m) {
  return extent_m >= kLeastExtent_m && extent_m <= kMostExtent_m;
}

void print_file(const InfoArguments& arguments, const MeshFile& file) {
  print(arguments.file.string() + ": " + file.format + ", " + counts_and_size(file.mesh) + "\n");
  if (!is_plausible(extent_m(file.mesh))) {
    print("Implausible size: tissue is between 1 mm and 2 m across. Is --unit right?\n");
  }
  for (const MeshWarning& warning : file.warnings)
    print("Warning: " + warning.text + "\n  " + warning.advice + "\n");
}

void info_on_tissue(const InfoArguments& arguments) {
  if (!arguments.unit.empty())
    throw WrongUsage("info: --unit is for a mesh; a scene has surface.unit");
  const Tissue tissue = tissue_of(Scene::read(arguments.file, arguments.overrides));
  print("The tissue of " + arguments.file.string() + ": " + counts_and_size(tissue.surface.mesh()) +
        "\n");
  for (const std::string& warning : tissue.warnings) print("Warning: " + warning + "\n");
  print(surface_words(tissue.surface, "Next: palpate simulate or palpate plan on this scene.\n"));
}

void info_on_mesh(const InfoArguments& arguments) {
  if (arguments.unit.empty()) throw WrongUsage("info: a mesh needs --unit: mm, cm or m");
  if (!arguments.overrides.empty())
    throw WrongUsage("info: --set is for a scene (.json), and '" + arguments.file.string() +
                     "' is not one");
  const MeshFile file = read(arguments);
  print_file(arguments, file);
  const Attempt mesh = attempt(file.mesh);
  const double extent = extent_m(file.mesh);
  if (mesh.surface) {
    print(surface_words(
        *mesh.surface,
        is_plausible(extent)
            ? "Next: name it as surface.mesh of a scene (palpate help scene) and run palpate "
              "simulate or palpate plan.\n"
            : "Next: run this again with the right unit.\n"));
  } else if (extent > kLeastCountable_m && extent < kMostCountable_m) {
    print(fault_words(file.mesh, mesh.reason));
  } else {
    print("Not a surface to plan on: " + mesh.reason + "\n");
  }
  if (file.equal_vertices > 0) print(weld_words(arguments));
  if (!mesh.surface)
    print(
        "Next: repair it, by palpate mesh repair or in a mesh editor at these places, and run this "
        "again.\n");
}

}  // namespace

void info(const InfoArguments& arguments) {
  arguments.file.extension() == ".json" ? info_on_tissue(arguments) : info_on_mesh(arguments);
}

}  // namespace palpation::tool
