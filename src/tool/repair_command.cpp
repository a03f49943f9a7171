#include "tool/repair_command.h"

#include <cstdio>
#include <memory>
#include <optional>

#include "palpation/base/error.h"
#include "palpation/geometry/surface.h"
#include "scene/exit_code.h"
#include "scene/mesh_words.h"
#include "tool/mesh_file.h"

namespace palpation::tool {
namespace {

bool asks_for_any(const MeshRepair& repair) {
  return repair.weld_equal_vertices || repair.cut_polygons || repair.drop_duplicates ||
         repair.drop_flat || repair.keep_largest;
}

void check_output(const RepairFiles& files, const MeshFile& file) {
  if (file.height_sd.size() > 0 && files.output.extension() != ".ply")
    throw WrongUsage(
        "mesh repair: OUT must end with .ply: this mesh has height_sd, and no other format has a "
        "place for it");
}

/// What is still wrong is told as `palpate info` tells it.
void refuse_what_is_no_surface(const RepairFiles& files, const MeshFile& file) {
  try {
    Surface{file.mesh};
  } catch (const InvalidMesh& error) {
    throw IoError(files.input.string() + ": after these repairs: " +
                  fault_words(file.mesh, error.what()) + "Nothing was written.");
  }
}

void print_told(const MeshFile& file) {
  for (const MeshWarning& warning : file.warnings)
    std::printf("%s\n  %s\n", warning.text.c_str(), warning.advice.c_str());
  if (file.warnings.empty()) std::printf("Nothing of what was asked for was found in it.\n");
  if (file.frame != Frame::Mesh)
    std::printf(
        "The file says that its frame is %s, and OUT has no place for that: say it by "
        "surface.frame.\n",
        name_of(file.frame).c_str());
}

}  // namespace

void repair_mesh(const RepairFiles& files, const MeshRepair& repair) {
  if (!asks_for_any(repair))
    throw WrongUsage(
        "mesh repair: nothing is repaired that is not asked for: name --weld, --triangulate, "
        "--drop-duplicates, --drop-degenerate or --largest (palpate info tells what a mesh needs)");
  const LengthUnit unit = length_unit(files.unit);
  const MeshFile file = read_mesh(files.input, unit, repair);
  check_output(files, file);
  print_told(file);
  refuse_what_is_no_surface(files, file);
  write_mesh_file(files.output, file.mesh, unit, file.height_sd,
                  files.overwrite ? Existing::Replaced : Existing::Kept);
  std::printf("%s: %ld vertices, %ld triangles, %s\nNext: palpate info %s --unit %s\n",
              files.output.string().c_str(), static_cast<long>(file.mesh.vertices.rows()),
              static_cast<long>(file.mesh.triangles.rows()), size_words(file.mesh).c_str(),
              files.output.string().c_str(), files.unit.c_str());
}

void add_repair_command(CLI::App& mesh) {
  struct Asked {
    RepairFiles files;
    MeshRepair repair;
  };
  const auto asked = std::make_shared<Asked>();  // lives as long as the command
  CLI::App* command = mesh.add_subcommand(
      "repair", "Mend a mesh: only what is asked for, each repair told with its first place");
  command->add_option("IN", asked->files.input, "a mesh (OBJ, OFF, STL, PLY or VTP)")->required();
  command->add_option("OUT", asked->files.output, "file to write: .ply, .obj, .off or .stl")
      ->required();
  command->add_option("--unit", asked->files.unit, "of the coordinates of both: mm, cm or m")
      ->required()
      ->check(CLI::IsMember({"mm", "cm", "m"}));
  command->add_flag("--weld", asked->repair.weld_equal_vertices,
                    "join vertices with equal coordinates");
  command->add_flag("--triangulate", asked->repair.cut_polygons,
                    "cut polygons also where none of their corners sees them as a whole");
  command->add_flag("--drop-duplicates", asked->repair.drop_duplicates,
                    "of triangles with the same corners keep the first");
  command->add_flag("--drop-degenerate", asked->repair.drop_flat,
                    "drop what has no area; neighbours along it are cut, so that no crack is left");
  command->add_flag("--largest", asked->repair.keep_largest,
                    "keep the component of the largest area");
  command->add_flag("--overwrite", asked->files.overwrite, "replace another mesh of that name");
  command->callback([asked] { repair_mesh(asked->files, asked->repair); });
}

}  // namespace palpation::tool
