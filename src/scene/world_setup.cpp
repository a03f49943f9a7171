// What a scene's simulated probe touches.
#include <utility>

#include "palpation/base/contract.h"
#include "scene/bound_keys.h"
#include "scene/setup.h"
#include "scene/tumours.h"

namespace palpation::tool {
namespace {

constexpr std::uint64_t kWorldStream = 0x776f726c64u;

StiffnessModel stiffness_of(const Scene& scene) {
  StiffnessModel model = bound(scene, stiffness_keys());
  model.fraction = bound(scene, model_keys()).level.fraction;  // as the estimate's
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
  } catch (const BrokenContract& error) {
    refuse_tumours(scene, surface, tumours_of(scene));
    if (error.value() == "bias axis") scene.refuse("probe.bias_axis", error.rule());
    scene.refuse("probe", rule_words(error));
  }
}

}  // namespace palpation::tool
