#include "scene/speed.h"

#include <algorithm>

#include "scene/scene_schema.h"

namespace palpation::tool {

const nlohmann::json& exact_value(const std::string& path) {
  return std::ranges::find(scene_keys(), path, &SceneKey::path)->standard;
}

const std::vector<SpeedPart>& speed_parts(const std::string& speed) {
  static const std::vector<SpeedPart> exact = {};
  static const std::vector<SpeedPart> fast = {{"plan.explore_mm", 0.5},
                                              {"error.arithmetic", "plain"}};
  static const std::vector<SpeedPart> draft = {
      {"plan.explore_mm", 1.0}, {"error.arithmetic", "plain"}, {"certainty", "laplace"}};
  return speed == "fast" ? fast : speed == "draft" ? draft : exact;
}

}  // namespace palpation::tool
