/// Keys of a scene that set a member of the library's options.
///
/// Each is bound once, to its member: the default stands there, `help scene` and summary.json have
/// it from there, and there the scene's value goes. What no single member holds is read in
/// setup.cpp.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "palpation/exploration/model.h"
#include "palpation/exploration/plan.h"
#include "palpation/exploration/reach.h"
#include "palpation/exploration/waypoint.h"
#include "palpation/robot/limits.h"
#include "palpation/world/phantom.h"
#include "scene/scene.h"

namespace palpation::tool {

/// The probe's readings on its way are this far apart, as the robot's are (Garg et al. 2016,
/// section VII).
inline constexpr double kWayStep_m = 0.001;

template <typename Options>
struct BoundKey {
  std::string path;
  /// The member in the key's unit; null where it holds nothing.
  std::function<nlohmann::json(const Options&)> told;
  std::function<void(Options&, const nlohmann::json&)> set;
  std::vector<std::string> words{};  ///< where its value is one of these
};

template <typename Options>
using BoundKeys = std::vector<BoundKey<Options>>;

const BoundKeys<FieldModel>& field_keys();
/// The field's apart.
const BoundKeys<Model>& model_keys();
const BoundKeys<Plan>& plan_keys();
const BoundKeys<Robot>& robot_keys();
const BoundKeys<Access>& access_keys();
const BoundKeys<GateLimits>& limit_keys();
const BoundKeys<StiffnessModel>& stiffness_keys();

/// The options with every member set whose key the scene gives.
template <typename Options>
Options bound(const Scene& scene, const BoundKeys<Options>& keys, Options options = {}) {
  for (const BoundKey<Options>& key : keys)
    if (scene.has(key.path)) key.set(options, scene.value(key.path));
  return options;
}

/// What a key has from its member.
struct FromMember {
  nlohmann::json standard;  ///< null where the member holds nothing by default
  std::vector<std::string> words;
};
/// Nothing where the key sets no single member.
std::optional<FromMember> from_member(const std::string& path);

}  // namespace palpation::tool
