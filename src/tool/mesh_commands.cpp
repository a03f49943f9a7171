// mesh: phantoms.
#include <algorithm>
#include <cstdio>

#include "palpation/base/error.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/io/read_mesh.h"
#include "palpation/io/recording.h"
#include "tool/commands.h"
#include "tool/mesh_words.h"

namespace palpation::tool {

void make_mesh(const MeshArguments& arguments) {
  PlaneOptions options{.jitter = arguments.jitter};
  if (arguments.around.empty()) {
    options.size_m = Vec2(arguments.size_mm[0], arguments.size_mm[1]) / 1000.0;
    options.columns = arguments.vertices[0];
    options.rows = arguments.vertices[1];
  } else {
    require(arguments.edge_mm > 0.0, "mesh", "--edge-mm " + text_of(arguments.edge_mm), "must be positive");
    const RecordedReadings recording = read_recording(arguments.around);
    const Vec2 margin = Vec2::Constant(arguments.margin_mm / 1000.0);
    options.corner_m = recording.positions.leftCols<2>().colwise().minCoeff().transpose() - margin;
    options.size_m = recording.positions.leftCols<2>().colwise().maxCoeff().transpose() + margin - options.corner_m;
    const Vec2 cells = (options.size_m * 1000.0 / arguments.edge_mm).array().ceil();
    require(cells.maxCoeff() < 1e5, "mesh", "--edge-mm " + text_of(arguments.edge_mm), "is too fine for this recording");
    options.columns = static_cast<int>(cells.x()) + 1;
    options.rows = static_cast<int>(cells.y()) + 1;
  }
  Random random(arguments.seed);
  const TriangleMesh mesh = make_plane(options, random);
  write_mesh(arguments.output, mesh, length_unit(arguments.unit));
  std::printf("%s: %ld vertices, %ld triangles, %s\n", arguments.output.string().c_str(), static_cast<long>(mesh.vertices.rows()),
              static_cast<long>(mesh.triangles.rows()), size_words(mesh).c_str());
}

}  // namespace palpation::tool
