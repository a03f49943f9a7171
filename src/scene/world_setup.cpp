// What a scene's simulated probe touches.
#include <utility>

#include "palpation/base/error.h"
#include "scene/setup.h"
#include "scene/tumours.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

constexpr std::uint64_t kWorldStream = 0x776f726c64u;

StiffnessModel stiffness_of(const Scene& scene) {
  StiffnessModel model;
  model.low = scene.number("probe.low");
  model.high = scene.number("probe.high");
  model.slope_per_m = scene.number("probe.slope_per_m");
  model.noise = scene.number("probe.noise");
  model.bias = scene.number("probe.bias");
  model.fraction = scene.number("level.fraction");
  model.lag_m = scene.metres("probe.lag_mm");
  if (scene.gives("probe.bias_axis")) {
    const std::vector<double> axis = scene.numbers("probe.bias_axis");
    model.bias_axis = Vec3(axis[0], axis[1], axis[2]).stableNormalized();
  }
  return model;
}

/// Of a family of the catalogue, drawn by the seed.
DrawnWorld drawn_world(const Scene& scene, const Surface& surface) {
  if (!scene.tumours().empty())
    scene.refuse("probe.world", "stands in place of probe.tumours: give one of them");
  const Points& vertices = surface.mesh().vertices;
  const Vec3 least = vertices.colwise().minCoeff().transpose(),
             extent = vertices.colwise().maxCoeff().transpose() - least;
  if (extent.z() > 1e-9)
    scene.refuse("probe.world", "needs flat tissue along x and y, since it is drawn in that plane");
  Random random(scene.seed() ^ kWorldStream);
  try {
    return draw_world(scene.word("probe.world"), random,
                      {.size_m = extent.head<2>(), .corner_m = least}, stiffness_of(scene));
  } catch (const InvalidInput& error) {
    scene.refuse("probe.world", "cannot be drawn on this tissue: " + std::string(error.what()));
  }
}

}  // namespace

DrawnWorld world_of(const Scene& scene, const Surface& surface) {
  if (scene.has("probe.world")) return drawn_world(scene, surface);
  DrawnWorld world;
  world.design.model = stiffness_of(scene);
  std::vector<Tumour> tumours = tumours_of(scene);
  for (Tumour& tumour : tumours) world.design.lumps.emplace_back().outline = std::move(tumour);
  return world;
}

Phantom phantom_of(const Scene& scene, const Surface& surface, const PhantomDesign& design) {
  try {
    return Phantom(surface, design);
  } catch (const InvalidInput& error) {
    refuse_tumours(scene, surface, tumours_of(scene));
    const std::string words = without("Phantom: ", error.what());
    const std::string axis = "bias axis ";
    scene.refuse(words.starts_with(axis) ? "probe.bias_axis" : "probe", without(axis, words));
  }
}

}  // namespace palpation::tool
