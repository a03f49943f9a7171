#include "tool/mesh_file.h"

#include "palpation/io/atomic_file.h"
#include "palpation/io/read_mesh.h"
#include "scene/run_record.h"

namespace palpation::tool {

void write_mesh_file(const std::filesystem::path& path, const TriangleMesh& mesh, LengthUnit unit,
                     const Field& height_sd, Existing existing) {
  const auto write = [&](const std::filesystem::path& to) {
    height_sd.size() > 0 ? write_mesh(to, mesh, unit, height_sd) : write_mesh(to, mesh, unit);
  };
  remove_leftovers(path);
  if (!std::filesystem::exists(path)) return write(path);
  write_atomically(path, [&](const std::filesystem::path& beside) {
    write(beside);
    if (fingerprint_of_file(beside) != fingerprint_of_file(path)) refuse_to_replace(path, existing);
  });
}

}  // namespace palpation::tool
