#include "scene/spellings.h"

#include <algorithm>
#include <utility>

namespace palpation::tool {
namespace {

using nlohmann::json;

struct OtherName {
  const char* path;
  const char* of;  ///< the schema's
  bool is_going;   ///< it works in this release, with a remark
};

constexpr OtherName kOtherNames[] = {
    {"surface.patch.center_mm", "surface.patch.centre_mm", false},
    {"probe.tumors", "probe.tumours", false},
    {"plan.assumed_contrast", "plan.min_contrast", true},
};

/// Whether it was done: not where the new name is taken.
bool rename(json& object, const std::string& from, const std::string& to) {
  if (!object.is_object() || !object.contains(from) || object.contains(to)) return false;
  json value = std::move(object[from]);
  object.erase(from);
  object[to] = std::move(value);
  return true;
}

bool rename(json& scene, const OtherName& name) {
  const json::json_pointer from = pointer_to(name.path), to = pointer_to(name.of);
  if (!scene.contains(from)) return false;
  return rename(scene[from.parent_pointer()], from.back(), to.back());
}

std::string in_small_letters(std::string text) {
  for (char& letter : text) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return text;
}

}  // namespace

std::string schema_path(const std::string& path) {
  for (const OtherName& name : kOtherNames) {
    if (path == name.path) return name.of;
  }
  return path;
}

std::vector<std::string> names_of_key(const std::string& path) {
  std::vector<std::string> names = {path};
  for (const OtherName& name : kOtherNames) {
    if (path == name.of) names.emplace_back(name.path);
  }
  return names;
}

json respelled_value(const SceneKey& key, json value) {
  if (key.kind == ValueKind::Tumours && value.is_array()) {
    for (json& tumour : value) rename(tumour, "center_mm", "centre_mm");
  }
  if (!value.is_string() || key.path != "plan.acquisition") return value;
  const std::string word = in_small_letters(value.get<std::string>());
  const bool is_known = std::find(key.words.begin(), key.words.end(), word) != key.words.end();
  return is_known ? json(word) : value;
}

Respelled respelled(json scene) {
  Respelled result{std::move(scene), {}};
  for (const OtherName& name : kOtherNames) {
    if (rename(result.scene, name) && name.is_going)
      result.remarks.push_back(std::string(name.path) + ": is now called " + name.of +
                               "; the old name works in this release only.");
  }
  for (const SceneKey& key : scene_keys()) {
    const json::json_pointer place = pointer_to(key.path);
    if (result.scene.contains(place))
      result.scene[place] = respelled_value(key, std::move(result.scene[place]));
  }
  return result;
}

}  // namespace palpation::tool
