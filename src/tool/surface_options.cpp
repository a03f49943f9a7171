#include <memory>

#include "tool/surface_command.h"

namespace palpation::tool {

void add_surface_command(CLI::App& mesh) {
  const auto asked = std::make_shared<SurfaceArguments>();
  SurfaceArguments& arguments = *asked;
  CLI::App* command = mesh.add_subcommand(
      "surface", "Tissue from contact points or a point cloud, with how sure it is");
  ContactArguments& contacts = arguments.contacts;
  command
      ->add_option("--points", contacts.points,
                   "CSV with columns contact_x, contact_y, contact_z or x, y, z (metres, or with "
                   "_mm, _cm, _m behind their names), XYZ or PLY")
      ->required();
  command->add_option("OUT", arguments.output, "file to write: .ply")->required();
  command->add_flag("--overwrite", arguments.overwrite, "replace another file of that name");
  command
      ->add_option("--unit", contacts.unit,
                   "of the points, where names of columns do not tell: mm, cm or m")
      ->check(CLI::IsMember({"mm", "cm", "m"}));
  command->add_option("--columns", contacts.columns, "of a CSV: where its points are, x y z")
      ->expected(3)
      ->allow_extra_args(false);
  command
      ->add_option("--normals", contacts.normals,
                   "of a CSV: columns of a direction out of the tissue, x y z")
      ->expected(3)
      ->allow_extra_args(false);
  command
      ->add_option("--up", contacts.up,
                   "the side from which the probe came, x y z, in place of what the file says")
      ->expected(3)
      ->allow_extra_args(false);
  command->add_option("--edge-mm", arguments.edge_mm,
                      "of the triangles; 0: half the distance of the contacts");
  command->add_option("--gap", arguments.gap,
                      "widest gap that is closed, in distances of the contacts; at least 1.5");
  command->add_option("--noise-mm", arguments.noise_mm,
                      "by which standard deviation the surface may miss the contacts: more is "
                      "smoother; 0: learned from them");
  command
      ->add_option(
          "--by", arguments.by,
          "how points are joined: seen along one direction (projection), in space (front); "
          "auto: by their shape")
      ->check(CLI::IsMember({"auto", "projection", "front"}));
  command->callback([asked] { make_surface(*asked); });
}

}  // namespace palpation::tool
