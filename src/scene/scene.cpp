#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "palpation/base/error.h"
#include "scene/scene_json.h"
#include "scene/scene_schema.h"
#include "scene/speed.h"
#include "scene/spellings.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr double kLeastContrast = 1e-30;
constexpr double kLeastRelativeContrast = 1e-12;

const SceneKey* find_key(const std::string& path) {
  const auto& keys = scene_keys();
  const auto found = std::ranges::find(keys, path, &SceneKey::path);
  return found == keys.end() ? nullptr : &*found;
}

/// The first key of a group of keys, or nothing where there is no such group.
const SceneKey* first_of_group(const std::string& path) {
  const auto& keys = scene_keys();
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const SceneKey& key) {
    return key.path.starts_with(path + ".");
  });
  return found == keys.end() ? nullptr : &*found;
}

std::string unknown_words(const std::string& path) {
  const std::string list = path.substr(0, path.find_first_of("[0123456789"));
  const std::string key = list.substr(0, list.find_last_not_of(".[") + 1);
  if (key.size() < path.size() && find_key(key) != nullptr)
    return "is a part of " + key + ": a list is set as a whole";
  return "is not a key of a scene; the nearest is " + nearest_key(path, scene_keys()) +
         " (palpate help scene lists all)";
}

/// A value as --set has it: JSON, or else a plain word. Paths need no quotes; null takes a key
/// away.
json override_value(const SceneKey& key, const std::string& text, const std::string& name) {
  if (text.empty()) throw IoError(name + ": has no value: write KEY=VALUE, such as plan.batch=5");
  if (text == "null") return nullptr;
  const bool is_word = key.kind == ValueKind::Text || key.kind == ValueKind::Word;
  if (is_word && text.front() != '"') return text;
  try {
    return parse_json(text, name);
  } catch (const NumberTooLarge&) {
    throw;
  } catch (const IoError&) {
    if (std::string_view("[{\"").find(text.front()) != std::string_view::npos) throw;
    return text;
  }
}

/// Whether all objects that a path leads through are objects, or not there yet. Where they are not,
/// the scene is refused for that.
bool leads_through_objects(const json& given, const std::string& path) {
  const json* here = &given;
  for (std::size_t start = 0, dot = path.find('.'); dot != std::string::npos;
       start = dot + 1, dot = path.find('.', start)) {
    if (!here->is_object()) return false;
    const auto member = here->find(path.substr(start, dot - start));
    if (member == here->end()) return true;
    here = &*member;
  }
  return here->is_object();
}

void take_away(json& given, const std::string& path) {
  const json::json_pointer place = pointer_to(path);
  if (given.contains(place)) given[place.parent_pointer()].erase(place.back());
}

json overridden(json given, std::span<const std::string> overrides) {
  std::set<std::string> seen;
  for (const std::string& override : overrides) {
    const auto equals = override.find('=');
    if (equals == std::string::npos || equals == 0)
      throw IoError("--set " + shown_key(override) +
                    ": must have the form KEY=VALUE, such as plan.batch=5");
    const std::string written = override.substr(0, equals), key = schema_path(written);
    const std::string name = "--set " + shown_key(written);
    const SceneKey* known = find_key(key);
    if (known == nullptr) {
      const SceneKey* member = first_of_group(key);
      throw IoError(name + ": " +
                    (member ? "is a group of keys: set one of them, such as " + member->path
                            : unknown_words(key)));
    }
    if (!seen.insert(key).second) throw IoError(name + ": is given twice");
    const json value =
        respelled_value(*known, override_value(*known, override.substr(equals + 1), name));
    if (!value.is_null()) {
      if (const std::optional<Fault> fault = fault_of(*known, value))
        throw IoError(name + fault->place + ": " + fault->words);
    }
    for (const std::string& path : names_of_key(key)) take_away(given, path);
    if (!value.is_null() && leads_through_objects(given, written))
      given[pointer_to(written)] = value;
  }
  return given;
}

}  // namespace

Scene::Scene(const json& given, std::string name, std::filesystem::path folder)
    : name_(std::move(name)), folder_(std::move(folder)) {
  Respelled scene = respelled(given);
  given_ = std::move(scene.scene);
  remarks_ = std::move(scene.remarks);
  if (!given_.is_object())
    throw IoError(name_ + ": is " + shown(given_) +
                  ", but must be a JSON object, such as { \"version\": 1, ... }");
  check_members(given_, "");
  check_together();
}

Scene Scene::read(const std::filesystem::path& path, std::span<const std::string> overrides) {
  return Scene(overridden(read_json(path), overrides), path.string(), path.parent_path());
}

Scene Scene::parse(std::string_view text, std::string name, std::filesystem::path folder,
                   std::span<const std::string> overrides) {
  const json given = overridden(parse_json(text, name), overrides);
  return Scene(given, std::move(name), std::move(folder));
}

Scene Scene::with(const std::string& path, const json& value) const {
  json changed = given_;
  changed[pointer_to(path)] = value;
  return with_given(changed);
}

Scene Scene::with_overrides(std::span<const std::string> overrides) const {
  return with_given(overridden(given_, overrides));
}

Scene Scene::with_given(const json& given) const {
  Scene changed(given, name_, folder_);
  changed.remarks_.insert(changed.remarks_.begin(), remarks_.begin(), remarks_.end());
  return changed;
}

void Scene::refuse(const std::string& path, const std::string& words) const {
  throw IoError(name_ + ": " + path + ": " + words);
}

void Scene::refuse_value(const std::string& path, const std::string& rule) const {
  refuse(path, "is " + shown(value(path)) + ", but must be " + rule);
}

/// Each value by itself, and no value under an unknown name.
void Scene::check_members(const json& object, const std::string& prefix) const {
  for (auto member = object.begin(); member != object.end(); ++member) {
    const std::string path = prefix + member.key();
    const bool is_name = member.key().find('.') ==
                         std::string::npos;  // "plan.batch" in one word would be read by nobody
    const SceneKey* key = is_name ? find_key(path) : nullptr;
    if (key != nullptr) {
      if (path == "version" && member->is_number() && member->get<double>() > kSceneVersion)
        refuse(path, "is " + shown(*member) + ", but this program reads version " +
                         std::to_string(kSceneVersion) + ": it is older than the scene");
      if (const std::optional<Fault> fault = fault_of(*key, *member))
        refuse(path + fault->place, fault->words);
    } else if (is_name && first_of_group(path) != nullptr) {
      if (!member->is_object()) refuse(path, "is " + shown(*member) + ", but must be an object");
      check_members(*member, path + ".");
    } else if (!is_name && find_key(path) != nullptr) {
      refuse(shown_key(path), "is written in one word: write \"" + path.substr(0, path.find('.')) +
                                  "\": { ... } around it");
    } else {
      refuse(shown_key(path), unknown_words(path));
    }
  }
}

/// Values that are sound by themselves but contradict each other.
void Scene::check_together() const {
  if (gives("surface.mesh") && gives("surface.plane"))
    refuse("surface", "has both a mesh and a plane: give one of them");
  const double low = number("probe.low"), high = number("probe.high");
  if (high <= low)
    refuse_value("probe.high", "above probe.low, which is " + shown(value("probe.low")));
  const double least =
      std::max(kLeastContrast, kLeastRelativeContrast * std::max(std::abs(low), std::abs(high)));
  if (high - low < least)
    refuse_value("probe.high", "more than " + text_of(least) +
                                   " above probe.low, or readings cannot tell them apart");
  if (gives("probe.bias_axis") && value("probe.bias_axis") == json({0, 0, 0}))
    refuse("probe.bias_axis", "must not be zero: leave it out for the longest side");
  for (const char* direction : {"surface.patch.facing", "robot.shaft_direction"}) {
    if (gives(direction) && value(direction) == json({0, 0, 0}))
      refuse(direction, "must not be zero: leave it out for any direction");
  }
  if (gives("surface.patch.box_mm")) {
    const std::vector<double> box = numbers("surface.patch.box_mm");
    if (box[0] >= box[3] || box[1] >= box[4] || box[2] >= box[5])
      refuse_value("surface.patch.box_mm", "two corners, the second one greater along every axis");
  }
}

std::vector<std::string> Scene::warnings() const {
  std::vector<std::string> warnings;
  for (const std::string& remark : remarks_) warnings.push_back(name_ + ": " + remark);
  const auto warn = [&](const std::string& path, bool has_effect, const std::string& because) {
    if (gives(path) && !has_effect)
      warnings.push_back(name_ + ": " + path + ": has no effect, since " + because + ".");
  };
  warn("level.value", word("level.estimate") == "known",
       "level.estimate is " + word("level.estimate"));
  warn("field.period_mm", word("field.kernel") == "periodic",
       "field.kernel is " + word("field.kernel"));
  warn("field.constant_sd", word("field.trend") != "zero", "field.trend is zero");
  warn("field.length_prior_mm", word("field.length_mm") == "learn", "field.length_mm is given");
  warn("surface.patch.within_deg", gives("surface.patch.facing"),
       "there is no surface.patch.facing");
  warn("robot.cone_deg", gives("robot.shaft_direction"), "there is no robot.shaft_direction");
  warn("robot.probe_radius_mm", metres("robot.clearance_mm") > 0.0,
       "there is no robot.clearance_mm");
  warn("surface.unit", gives("surface.mesh"), "there is no surface.mesh");
  warn("plan.explore_mm",
       word("plan.acquisition") != "raster" && word("plan.acquisition") != "refinement",
       "plan.acquisition is " + word("plan.acquisition"));
  warn("surface.weld", gives("surface.mesh"), "there is no surface.mesh");
  warn("field.heavy_tails", false, "readings that tell nothing are part of the noise, always");
  return warnings;
}

const json& Scene::value(const std::string& path) const {
  const auto pointer = pointer_to(path);
  if (given_.contains(pointer)) return given_.at(pointer);
  if (const json* of_speed = value_of_speed(path)) return *of_speed;
  const SceneKey* key = find_key(path);
  require(key != nullptr, "Scene", path, "is not in the schema");
  if (key->standard.is_null()) refuse(path, "is needed here: " + key->meaning);
  return key->standard;
}

/// What the scene's speed says of a key that is not given; or nothing.
const json* Scene::value_of_speed(const std::string& path) const {
  const auto speed = given_.find("speed");
  if (speed == given_.end() || !speed->is_string()) return nullptr;
  for (const SpeedPart& part : speed_parts(speed->get<std::string>())) {
    if (part.path == path) return &part.value;
  }
  return nullptr;
}

bool Scene::has(const std::string& path) const {
  const SceneKey* key = find_key(path);
  return gives(path) || value_of_speed(path) != nullptr ||
         (key != nullptr && !key->standard.is_null());
}

bool Scene::gives(const std::string& path) const { return given_.contains(pointer_to(path)); }

double Scene::number(const std::string& path) const { return value(path).get<double>(); }
int Scene::integer(const std::string& path) const {
  return static_cast<int>(value(path).get<double>());
}
std::uint64_t Scene::seed() const {
  return static_cast<std::uint64_t>(value("seed").get<double>());
}
bool Scene::truth(const std::string& path) const { return value(path).get<bool>(); }
std::string Scene::word(const std::string& path) const {
  return value(path).is_string() ? value(path).get<std::string>() : "";
}
std::vector<double> Scene::numbers(const std::string& path) const {
  return value(path).get<std::vector<double>>();
}
double Scene::metres(const std::string& path) const { return number(path) / 1000.0; }

Vec3 Scene::point_m(const std::string& path) const {
  const std::vector<double> mm = numbers(path);
  return Vec3(mm[0], mm[1], mm[2]) / 1000.0;
}

std::vector<std::vector<double>> Scene::points_mm(const std::string& path) const {
  return value(path).get<std::vector<std::vector<double>>>();
}

const json& Scene::tumours() const { return value("probe.tumours"); }

json Scene::complete() const {
  json all = given_;
  for (const SceneKey& key : scene_keys()) {
    if (has(key.path)) all[pointer_to(key.path)] = value(key.path);
  }
  return all;
}

}  // namespace palpation::tool
