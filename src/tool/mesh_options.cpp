#include "tool/mesh_options.h"

#include <memory>

#include "tool/commands.h"
#include "tool/option_checks.h"
#include "tool/repair_command.h"
#include "tool/surface_command.h"

namespace palpation::tool {
namespace {

/// Of the curved phantoms.
void add_shape_options(CLI::App& making, MeshArguments& mesh) {
  const auto shape = [&](const char* name, std::optional<double>& length_mm, const char* meaning) {
    making.add_option(name, length_mm, meaning)->check(number(1e-3, 1e6));
  };
  shape("--radius-mm", mesh.radius_mm,
        "of a cylinder (15), a dome's sphere (25), or a saddle's curvature in its middle (25)");
  shape("--reach-mm", mesh.reach_mm,
        "of a dome, from its top to its border along the surface (20.5)");
  shape("--amplitude-mm", mesh.amplitude_mm, "of a wave (2)");
  shape("--wavelength-mm", mesh.wavelength_mm, "of a wave, along y (20)");
  shape("--gap-mm", mesh.gap_mm, "between the flanks of a folded sheet (1.5)");
  shape("--flank-mm", mesh.flank_mm,
        "how long each of its flanks is (20); --size-mm's second number is how wide (25)");
}

}  // namespace

void add_mesh_command(CLI::App& app) {
  const auto arguments = std::make_shared<MeshArguments>();
  MeshArguments& mesh = *arguments;
  CLI::App* making =
      app.add_subcommand("mesh", "Make a phantom, or a surface from contacts; or repair one");
  CLI::Option* kind =
      making->add_option("KIND", mesh.kind, "which phantom")->check(CLI::IsMember(mesh_kinds()));
  CLI::Option* output =
      making->add_option("OUT", mesh.output, "file to write: .ply, .obj, .off or .stl");
  CLI::Option* size = making
                          ->add_option("--size-mm", mesh.size_mm,
                                       "along x (of a cylinder: along its arc) and y (25 50)")
                          ->expected(2)
                          ->allow_extra_args(false)
                          ->check(number(1e-3, 1e6));
  CLI::Option* vertices =
      making->add_option("--vertices", mesh.vertices, "of a plane, along x and y (200 200)")
          ->expected(2)
          ->allow_extra_args(false)
          ->check(whole(2, 20000));
  making
      ->add_option("--jitter", mesh.jitter, "move inner vertices by up to this fraction of a cell")
      ->check(number(0.0, 0.45));
  CLI::Option* around = making
                            ->add_option("--around", mesh.around,
                                         "a plane that spans this recording instead of --size-mm")
                            ->excludes(size, vertices);
  making->add_option("--margin-mm", mesh.margin_mm, "around the recording")
      ->needs(around)
      ->check(number(0.0, 1e6));
  making
      ->add_option("--edge-mm", mesh.edge_mm,
                   "length of the cells (0.5), of a plane instead of --vertices")
      ->excludes(vertices)
      ->check(number(1e-3, 1e6));
  add_shape_options(*making, mesh);
  making->add_option("--seed", mesh.seed, "of the jitter")->check(whole(0, kMostSeed));
  making->add_option("--unit", mesh.unit, "of the file: mm, cm or m")
      ->check(CLI::IsMember({"mm", "cm", "m"}));
  making->add_flag("--overwrite", mesh.overwrite, "replace another mesh of that name");
  add_surface_command(*making);
  add_repair_command(*making);
  making->callback([arguments, making, kind, output] {
    if (!making->get_subcommands().empty()) return;
    for (const CLI::Option* needed : {kind, output}) {
      if (needed->count() == 0) throw CLI::RequiredError(needed->get_name());
    }
    make_mesh(*arguments);
  });
}

}  // namespace palpation::tool
