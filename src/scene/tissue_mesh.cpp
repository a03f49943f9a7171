#include "scene/tissue_mesh.h"

#include <algorithm>
#include <utility>

#include "palpation/geometry/make_plane.h"
#include "palpation/io/read_mesh.h"

namespace palpation::tool {
namespace {

constexpr double kLeastTissue_mm = 1.0;
constexpr int kMostVertices = 4'000'000;

TriangleMesh plane_of(const Scene& scene) {
  const std::vector<double> size_mm = scene.numbers("surface.plane.size_mm");
  const std::vector<double> vertices = scene.numbers("surface.plane.vertices");
  if (std::max(size_mm[0], size_mm[1]) < kLeastTissue_mm)
    scene.refuse_value("surface.plane.size_mm", "1 mm at least along one side, as tissue is");
  if (vertices[0] * vertices[1] > kMostVertices)
    scene.refuse_value("surface.plane.vertices", "at most 4 million in all");
  Random unused(0);
  return make_plane({.size_m = Vec2(size_mm[0], size_mm[1]) / 1000.0,
                     .columns = static_cast<int>(vertices[0]),
                     .rows = static_cast<int>(vertices[1])},
                    unused);
}

/// What nobody says stays the mesh's own frame.
Frame frame_given(const Scene& scene) {
  return scene.gives("surface.frame") ? frame_of(scene.word("surface.frame")) : Frame::Mesh;
}

}  // namespace

std::filesystem::path mesh_path(const Scene& scene) {
  const std::filesystem::path given = scene.word("surface.mesh"),
                              beside_scene = scene.folder() / given;
  std::error_code none;
  return !std::filesystem::exists(beside_scene, none) && std::filesystem::exists(given, none)
             ? given
             : beside_scene;
}

MeshOfScene mesh_of(const Scene& scene, std::vector<std::string>& warnings) {
  const Frame given = frame_given(scene);
  if (scene.gives("surface.plane.size_mm")) return {plane_of(scene), given};
  if (!scene.gives("surface.mesh"))
    scene.refuse("surface.mesh",
                 "is needed: the file of the tissue's mesh (or surface.plane.size_mm)");
  MeshFile file = read_mesh(mesh_path(scene), length_unit(scene.word("surface.unit")),
                            {.weld_equal_vertices = scene.truth("surface.weld")});
  for (const MeshWarning& warning : file.warnings) warnings.push_back(warning.text);
  if (given != Frame::Mesh && file.frame != Frame::Mesh && given != file.frame)
    scene.refuse_value("surface.frame", name_of(file.frame) + ", as the field data of " +
                                            mesh_path(scene).string() +
                                            " say, or be left out: one of the two is wrong");
  return {std::move(file.mesh), given != Frame::Mesh ? given : file.frame};
}

}  // namespace palpation::tool
