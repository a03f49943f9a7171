// Mesh files of every format, and the surface made of them.
#include "fuzz/target.h"
#include "palpation/base/error.h"
#include "palpation/boundary/level_set.h"
#include "palpation/io/read_mesh.h"

namespace palpation::fuzz {
namespace {

constexpr Eigen::Index kSmall = 2000;

void check_promises(const TriangleMesh& mesh) {
  expect(mesh.triangles.rows() > 0, "a mesh that was read has triangles");
  expect(mesh.triangles.minCoeff() >= 0 && mesh.triangles.maxCoeff() < mesh.vertices.rows(),
         "indices are in range");
  expect(mesh.vertices.allFinite(), "coordinates are finite");
}

void use(const Surface& surface) {
  expect(surface.area() > 0.0, "a surface has an area");
  const Field heights = surface.mesh().vertices.col(0);
  const double level = 0.5 * heights.minCoeff() + 0.5 * heights.maxCoeff();
  const double area = superlevel_area(surface, heights, level);
  expect(area >= 0.0 && area <= surface.area() * (1.0 + 1e-9),
         "a part is no larger than the whole");
  for (const LevelLoop& loop : level_loops(surface, heights, level))
    expect(loop.points.size() >= 2, "a loop goes somewhere");
}

}  // namespace
}  // namespace palpation::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace palpation;
  const fuzz::MemoryFile file(bytes, size);
  constexpr MeshRepair kAll{.weld_equal_vertices = true,
                            .cut_polygons = true,
                            .drop_duplicates = true,
                            .drop_flat = true,
                            .keep_largest = true};
  for (const MeshRepair& repair : {MeshRepair{}, MeshRepair{.weld_equal_vertices = true}, kAll}) {
    try {
      const MeshFile read = read_mesh_of_any_size(file.path(), LengthUnit::Millimetre, repair);
      fuzz::check_promises(read.mesh);
      const Surface surface(read.mesh);
      if (surface.face_count() <= fuzz::kSmall) fuzz::use(surface);
    } catch (const Error&) {
    }
  }
  return 0;
}
