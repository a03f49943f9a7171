// compare: two boundaries on one tissue.
#include <cstdio>

#include "palpation/base/error.h"
#include "palpation/boundary/region_error.h"
#include "palpation/io/read_boundary.h"
#include "palpation/io/wkt.h"
#include "tool/commands.h"
#include "tool/output_folder.h"
#include "tool/setup.h"
#include "tool/words.h"

namespace palpation::tool {
namespace {

constexpr double kMargin_m = 0.005;

Region read_any(const std::filesystem::path& path, const Surface& surface) {
  if (path.extension() == ".wkt") return read_wkt(path);
  if (path.extension() == ".vtp") return read_boundary_vtp(path, surface);
  throw IoError(path.string() + ": a boundary is a .wkt or a .vtp file");
}

/// A boundary of this tissue lies on it: one in millimetres or of another tissue does not.
Region read_region(const std::filesystem::path& path, const Surface& surface) {
  const Region region = read_any(path, surface);
  const Points2& uv = surface.chart().uv;
  for (const PolygonWithHoles& polygon : region.polygons()) {
    for (const Vec2& corner : polygon.outer) {
      if ((corner.transpose().array() < uv.colwise().minCoeff().array() - kMargin_m).any() ||
          (corner.transpose().array() > uv.colwise().maxCoeff().array() + kMargin_m).any()) {
        throw IoError(path.string() + ": the corner (" + text_of(corner.x()) + ", " + text_of(corner.y()) +
                      ") lies more than 5 mm off the tissue: coordinates are metres in the chart of the scene's tissue");
      }
    }
  }
  return region;
}

}  // namespace

void compare_boundaries(const SceneArguments& arguments, const std::filesystem::path& a, const std::filesystem::path& b) {
  const Scene scene = Scene::read(arguments.scene, arguments.overrides);
  const Tissue tissue = tissue_of(scene);
  const RegionError error = compare(tissue.surface, read_region(a, tissue.surface), read_region(b, tissue.surface));
  if (!arguments.quiet) std::fputs(error_words(error, tissue.surface.area()).c_str(), stdout);
  if (arguments.out.empty()) return;
  OutputFolder output(arguments.out, scene, tissue.surface);
  output.write_comparison(error);
}

}  // namespace palpation::tool
