#include "tool/scene.h"

#include <algorithm>
#include <set>
#include <utility>

#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "tool/scene_schema.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr std::uintmax_t kMostBytes = 16u << 20;
constexpr int kMostDepth = 32;

const SceneKey* find_key(const std::string& path) {
  const auto& keys = scene_keys();
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const SceneKey& key) { return key.path == path; });
  return found == keys.end() ? nullptr : &*found;
}

json::json_pointer pointer_to(const std::string& path) {
  std::string pointer = "/" + path;
  std::replace(pointer.begin(), pointer.end(), '.', '/');
  return json::json_pointer(pointer);
}

bool is_group(const std::string& path) {
  return std::any_of(scene_keys().begin(), scene_keys().end(), [&](const SceneKey& key) { return key.path.starts_with(path + "."); });
}

/// JSON without duplicate keys and without nesting that no scene needs.
json parse(const std::string& content, const std::string& name) {
  std::vector<std::set<std::string>> open_objects;
  const auto watch = [&](int depth, json::parse_event_t event, json& parsed) {
    if (depth > kMostDepth) throw IoError(name + ": nested deeper than " + std::to_string(kMostDepth) + " levels, which no scene needs");
    if (event == json::parse_event_t::object_start) open_objects.emplace_back();
    if (event == json::parse_event_t::object_end) open_objects.pop_back();
    if (event == json::parse_event_t::key && !open_objects.back().insert(parsed.get<std::string>()).second) {
      throw IoError(name + ": the key \"" + parsed.get<std::string>() + "\" stands twice in one object");
    }
    return true;
  };
  try {
    return json::parse(content, watch);
  } catch (const json::parse_error& error) {
    std::string words = error.what();  // "[json.exception.parse_error.101] parse error at line 3, column 5: ..."
    if (const auto start = words.find("parse error"); start != std::string::npos) words = words.substr(start);
    throw IoError(name + ": not JSON: " + words);
  } catch (const json::out_of_range& error) {
    throw IoError(name + ": a number is too large for a double: " + error.what());
  }
}

void check_members(const Scene& scene, const json& object, const std::string& prefix) {
  for (const auto& [name, member] : object.items()) {
    const std::string path = prefix + name;
    if (const SceneKey* key = find_key(path)) {
      if (const std::string fault = fault_of(*key, member); !fault.empty()) scene.refuse(path, fault);
    } else if (is_group(path)) {
      if (!member.is_object()) scene.refuse(path, "must be an object");
      check_members(scene, member, path + ".");
    } else {
      scene.refuse(path, "is not a key of a scene; the nearest is " + nearest_key(path, scene_keys()) + " (palpate help scene lists all)");
    }
  }
}

}  // namespace

Scene::Scene(const json& given, std::string name, std::filesystem::path folder)
    : given_(given), name_(std::move(name)), folder_(std::move(folder)) {
  if (!given_.is_object()) throw IoError(name_ + ": must be a JSON object, such as { \"version\": 1, ... }");
  check_members(*this, given_, "");
}

Scene Scene::read(const std::filesystem::path& path, std::span<const std::string> overrides) {
  json given = parse(read_file(path, kMostBytes), path.string());
  for (const std::string& override : overrides) {
    const auto equals = override.find('=');
    if (equals == std::string::npos || equals == 0)
      throw IoError("--set " + override + ": must have the form KEY=VALUE, such as plan.batch=5");
    const std::string key = override.substr(0, equals);
    const std::string text = override.substr(equals + 1);
    json value = json::parse(text, nullptr, false);
    if (value.is_discarded()) value = text;
    if (find_key(key) == nullptr)
      throw IoError("--set " + key + ": is not a key of a scene; the nearest is " + nearest_key(key, scene_keys()));
    if (!given.is_object()) break;
    try {
      given[pointer_to(key)] = value;
    } catch (const json::exception&) {
      throw IoError(path.string() + ": " + key.substr(0, key.find('.')) + ": must be an object");
    }
  }
  return Scene(given, path.string(), path.parent_path());
}

Scene Scene::with(const std::string& path, const json& value) const {
  json changed = given_;
  changed[pointer_to(path)] = value;
  return Scene(changed, name_, folder_);
}

void Scene::refuse(const std::string& path, const std::string& words) const { throw IoError(name_ + ": " + path + ": " + words); }

const json& Scene::value(const std::string& path) const {
  const auto pointer = pointer_to(path);
  if (given_.contains(pointer)) return given_.at(pointer);
  const SceneKey* key = find_key(path);
  require(key != nullptr, "Scene", path, "is not in the schema");
  if (key->standard.is_null()) refuse(path, "is needed here: " + key->meaning);
  return key->standard;
}

bool Scene::has(const std::string& path) const {
  const SceneKey* key = find_key(path);
  return given_.contains(pointer_to(path)) || (key != nullptr && !key->standard.is_null());
}

double Scene::number(const std::string& path) const { return value(path).get<double>(); }
int Scene::integer(const std::string& path) const { return static_cast<int>(value(path).get<double>()); }
std::uint64_t Scene::seed() const { return static_cast<std::uint64_t>(value("seed").get<double>()); }
bool Scene::truth(const std::string& path) const { return value(path).get<bool>(); }
std::string Scene::word(const std::string& path) const { return value(path).is_string() ? value(path).get<std::string>() : ""; }
std::vector<double> Scene::numbers(const std::string& path) const { return value(path).get<std::vector<double>>(); }
double Scene::metres(const std::string& path) const { return number(path) / 1000.0; }

Vec3 Scene::point_m(const std::string& path) const {
  const std::vector<double> mm = numbers(path);
  return Vec3(mm[0], mm[1], mm[2]) / 1000.0;
}

const json& Scene::tumours() const { return value("probe.tumours"); }

json Scene::complete() const {
  json all = given_;
  for (const SceneKey& key : scene_keys()) {
    if (!key.standard.is_null() && !all.contains(pointer_to(key.path))) all[pointer_to(key.path)] = key.standard;
  }
  return all;
}

}  // namespace palpation::tool
