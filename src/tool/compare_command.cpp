// compare: two boundaries on one tissue.
#include <cstdio>

#include "palpation/base/error.h"
#include "palpation/boundary/level_set.h"
#include "palpation/boundary/region_error.h"
#include "palpation/io/read_boundary.h"
#include "palpation/io/wkt.h"
#include "scene/output_folder.h"
#include "scene/scene_json.h"
#include "scene/tissue.h"
#include "scene/words.h"
#include "tool/commands.h"

namespace palpation::tool {
namespace {

constexpr double kMargin_m = 0.005;
constexpr double kRounding = 1e-9;  // of the tissue's area: corners on its border, rounded

/// Curved tissue's chart is of one mesh and one patch; the summary beside a run's boundary tells of
/// which. Flat tissue's may be that of another mesh of the same plane.
void check_chart(const std::filesystem::path& path, const Surface& surface,
                 std::vector<std::string>& warnings) {
  const std::filesystem::path summary = path.parent_path() / "summary.json";
  if (!std::filesystem::exists(summary)) return;
  const nlohmann::json told = read_json(summary);
  if (!told.is_object() || !told.contains("chart_hash")) return;
  const nlohmann::json& there = told.at("chart_hash");
  const std::string here = surface.chart().hash();
  if (there == here) return;
  if (!surface.is_planar())
    throw IoError(path.string() + ": was drawn in the chart of another mesh or patch (" +
                  summary.string() + ": chart_hash is " + shown(there) +
                  ", of the scene's tissue " + here +
                  "): compare its boundary.vtp, which lies in space");
  warnings.push_back(path.string() + ": was drawn on another mesh (" + summary.string() +
                     ": chart_hash): it is compared as if that were of the same plane.");
}

Region read_any(const std::filesystem::path& path, const Surface& surface,
                std::vector<std::string>& warnings) {
  const bool is_wkt = path.extension() == ".wkt";
  if (!is_wkt && path.extension() != ".vtp")
    throw IoError(path.string() + ": a boundary is a .wkt or a .vtp file");
  if (is_wkt) check_chart(path, surface, warnings);
  const BoundaryFile file = is_wkt ? read_wkt(path) : read_boundary_vtp(path, surface);
  warnings.insert(warnings.end(), file.warnings.begin(), file.warnings.end());
  return file.region;
}

/// A boundary of this tissue lies on it: one in millimetres or of another tissue does not.
void check_place(const Region& region, const std::filesystem::path& path, const Surface& surface) {
  const Points2& uv = surface.chart().uv;
  const Vec2 least = uv.colwise().minCoeff().array() - kMargin_m,
             most = uv.colwise().maxCoeff().array() + kMargin_m;
  for (const PolygonWithHoles& polygon : region.polygons()) {
    for (const Vec2& corner : polygon.outer) {
      if ((corner.array() < least.array()).any() || (corner.array() > most.array()).any()) {
        throw IoError(path.string() + ": the corner (" + text_of(corner.x()) + ", " +
                      text_of(corner.y()) +
                      ") lies more than 5 mm off the tissue: coordinates are metres in the chart "
                      "of the scene's tissue");
      }
    }
  }
}

/// What lies beside the tissue is neither tumour nor healthy: it does not count, and is told.
Region read_region(const std::filesystem::path& path, const Surface& surface,
                   std::vector<std::string>& warnings) {
  const Region region = read_any(path, surface, warnings);
  check_place(region, path, surface);
  const Region tissue = superlevel_region(surface, Field::Zero(surface.vertex_count()), 0.0);
  const double beside_m2 =
      subtract(region, tissue).area();  // where the chart stretches nothing, as there is no tissue
  if (beside_m2 <= kRounding * surface.area()) return region;
  warnings.push_back(path.string() + ": " + fixed(beside_m2 * 1e6, 2) +
                     " mm2 of it lie beside the tissue and do not count.");
  return intersect(region, tissue);
}

}  // namespace

void compare_boundaries(const SceneArguments& arguments, const std::filesystem::path& a,
                        const std::filesystem::path& b) {
  const Scene scene = Scene::read(arguments.scene, arguments.overrides);
  const Tissue tissue = tissue_of(scene);
  std::vector<std::string> warnings = tissue.warnings;
  const Region estimate = read_region(a, tissue.surface, warnings);
  const Region truth = read_region(b, tissue.surface, warnings);
  tell(warnings);
  std::optional<OutputFolder> output;
  if (!arguments.out.empty())
    output.emplace(Destination{arguments.out, "compare", arguments.overwrite}, scene, tissue);
  const RegionError error = compare(tissue.surface, estimate, truth);
  if (!arguments.quiet)
    std::fputs(error_words(error, tissue.surface.area(),
                           "With " + b.filename().string() + " taken for the truth")
                   .c_str(),
               stdout);
  if (!output) return;
  for (const std::string& warning : warnings) output->warn(warning);
  output->write_comparison(error);
}

}  // namespace palpation::tool
