/// Every key of a scene: what it means, its unit, range and default. The one table that reads scenes, checks them and explains them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace palpation::tool {

enum class ValueKind {
  Number,  ///< a finite number
  Integer,
  Truth,         ///< true or false
  Word,          ///< one of `words`
  NumberOrWord,  ///< a number, or one of `words`
  Text,          ///< any text, such as a path
  Numbers,       ///< a list of exactly `count` numbers
  Tumours        ///< a list of shapes: see kTumourKeys
};

struct SceneKey {
  std::string path;  ///< dotted, as in --set
  ValueKind kind;
  std::string unit;
  double least = 0.0, most = 0.0;  ///< range of numbers, both included
  std::vector<std::string> words{};
  int count = 0;
  nlohmann::json standard = nullptr;  ///< the default; null where there is none
  std::string meaning;
};

const std::vector<SceneKey>& scene_keys();

/// The keys of one shape, `path` being the key's name in the shape.
const std::vector<SceneKey>& tumour_keys(const std::string& shape);
const std::vector<std::string>& tumour_shapes();

/// Checks one value. Returns what is wrong with it in words that follow "<key>: ", or nothing.
std::string fault_of(const SceneKey& key, const nlohmann::json& value);

/// The known path nearest to an unknown one (edit distance).
std::string nearest_key(const std::string& unknown, const std::vector<SceneKey>& keys);

/// What `palpate help scene` prints.
std::string scene_help();

}  // namespace palpation::tool
