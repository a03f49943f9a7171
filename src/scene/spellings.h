/// Other ways to write what a scene says: American spellings, words in the capitals that papers
/// give them, and names that keys had in earlier releases.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/scene_schema.h"

namespace palpation::tool {

/// A key of a scene by the name that the schema has for it; the same text where it has none.
std::string schema_path(const std::string& path);

/// All names of a key, its own first.
std::vector<std::string> names_of_key(const std::string& path);

/// A value as the schema spells it: "ILS-UCB" is ils-ucb, and a tumour's center_mm its centre_mm.
nlohmann::json respelled_value(const SceneKey& key, nlohmann::json value);

struct Respelled {
  nlohmann::json scene;
  std::vector<std::string>
      remarks;  ///< "plan.old: is now called plan.new", of names that are going
};

/// A scene as the schema spells it. A value that is given under two names stays under both, and the
/// schema refuses the one that it does not know.
Respelled respelled(nlohmann::json scene);

}  // namespace palpation::tool
