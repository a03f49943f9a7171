/// Every key of a scene: what it means, its unit, range and default. The one table that reads
/// scenes, checks them and explains them.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace palpation::tool {

inline constexpr int kSceneVersion = 1;

enum class ValueKind {
  Number,  ///< a finite number
  Integer,
  Truth,         ///< true or false
  Word,          ///< one of `words`
  NumberOrWord,  ///< a number, or one of `words`
  Text,          ///< any text, such as a path
  Numbers,       ///< a list of exactly `count` numbers
  Integers,      ///< a list of exactly `count` whole numbers
  Points,        ///< a list of at most `count` lists of three numbers
  Balls,         ///< the same with a positive radius as fourth number
  Tumours        ///< a list of at most `count` shapes: see tumour_keys
};

struct SceneKey {
  std::string path;  ///< dotted, as in --set
  ValueKind kind;
  std::string unit;
  double least = 0.0, most = 0.0;  ///< range of numbers, both included
  bool zero_too = false;           ///< 0 is allowed besides the range
  std::vector<std::string> words{};
  int count = 0;
  nlohmann::json standard = nullptr;  ///< the default; null where there is none
  std::string meaning;
};

const std::vector<SceneKey>& scene_keys();

/// The keys of one shape, `path` being the key's name in the shape.
const std::vector<SceneKey>& tumour_keys(const std::string& shape);
const std::vector<std::string>& tumour_shapes();

/// Where a key's value stands in the JSON of a scene.
nlohmann::json::json_pointer pointer_to(const std::string& path);

/// What is wrong with a value: where in it (behind the key's path, such as "[0].radius_mm"), and
/// words that follow "<key><place>: ".
struct Fault {
  std::string place;
  std::string words;
};
std::optional<Fault> fault_of(const SceneKey& key, const nlohmann::json& value);

/// The known path, or group of paths, nearest to an unknown one: by edit distance, a right name in
/// a wrong group being near.
std::string nearest_key(const std::string& unknown, const std::vector<SceneKey>& keys);

/// What `palpate help scene` prints.
std::string scene_help();
/// What `palpate help KEY` prints, of a key or a group of them; empty where there is none.
std::string key_help(const std::string& path);
/// The numbers that a key allows, in words.
std::string range_text(const SceneKey& key);

}  // namespace palpation::tool
