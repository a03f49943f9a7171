/// What the scene's `speed` stands for.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace palpation::tool {

/// A part of a tier: a key of the scene, and its value where the scene does not give it.
struct SpeedPart {
  std::string path;
  nlohmann::json value;
};

/// Of a part's key: what exact has.
const nlohmann::json& exact_value(const std::string& path);

/// The parts of exact (none), fast and draft.
const std::vector<SpeedPart>& speed_parts(const std::string& speed);

}  // namespace palpation::tool
