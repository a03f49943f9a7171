#include "session/differences.h"

#include <nlohmann/json.hpp>

namespace palpation {
namespace {

using nlohmann::json;

/// The keys of two texts that are JSON whose values differ, with both; else nothing.
std::string keys_that_differ(const std::string& then, const std::string& now) {
  const json before = json::parse(then, nullptr, false), after = json::parse(now, nullptr, false);
  if (!before.is_object() || !after.is_object()) return {};
  const json flat_before = before.flatten(), flat_after = after.flatten();
  std::string words;
  const auto add = [&](const std::string& key, const std::string& old, const std::string& fresh) {
    words += (words.empty() ? "" : "; ") + key.substr(1) + ": " + old + " then, " + fresh + " now";
  };
  for (const auto& [key, value] : flat_before.items()) {
    const json fresh = flat_after.value(key, json());
    if (fresh != value) add(key, value.dump(), fresh.dump());
  }
  for (const auto& [key, value] : flat_after.items()) {
    if (!flat_before.contains(key)) add(key, "not there", value.dump());
  }
  return words;
}

}  // namespace

std::string differences(const SessionIdentity& then, const SessionIdentity& now) {
  std::string words;
  const auto add = [&](const std::string& what) { words += (words.empty() ? "" : ", ") + what; };
  if (then.scene != now.scene) {
    const std::string keys = keys_that_differ(then.scene, now.scene);
    add("the scene" + (keys.empty() ? "" : " (" + keys + ")"));
  }
  if (then.tissue != now.tissue) add("the tissue");
  if (then.version != now.version)
    add("the version (" + then.version + " then, " + now.version + " now)");
  return words;
}

}  // namespace palpation
