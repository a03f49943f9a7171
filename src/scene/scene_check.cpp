// One value against one key of the schema, and the nearest key to one that is none.
#include <algorithm>
#include <cmath>

#include "palpation/base/error.h"
#include "scene/edit_distance.h"
#include "scene/scene_json.h"
#include "scene/scene_schema.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestKey =
    60;  // of an unknown key, as far as it is compared with the known ones

std::string join(const std::vector<std::string>& words, const std::string& between) {
  std::string result;
  for (const std::string& one : words) result += (result.empty() ? "" : between) + one;
  return result;
}

std::string is_but_must_be(const json& value, const std::string& rule) {
  return "is " + shown(value) + ", but must be " + rule;
}

/// Words, or nothing.
std::string number_fault(const SceneKey& key, const json& value) {
  if (!value.is_number()) return is_but_must_be(value, "a number");
  const double number = value.get<double>();
  const bool whole = key.kind == ValueKind::Integer || key.kind == ValueKind::Integers;
  if (whole && number != std::floor(number)) return is_but_must_be(value, "a whole number");
  if ((number >= key.least && number <= key.most) || (key.zero_too && number == 0.0)) return "";
  const bool has_unit = !key.unit.empty() && key.unit != "reading";
  return is_but_must_be(value, range_text(key) + (has_unit ? " " + key.unit : ""));
}

std::string word_fault(const SceneKey& key, const json& value) {
  if (value.is_string() &&
      std::find(key.words.begin(), key.words.end(), value.get<std::string>()) != key.words.end())
    return "";
  return is_but_must_be(value, (key.words.size() > 1 ? "one of " : "") + join(key.words, ", "));
}

std::string number_or_word_fault(const SceneKey& key, const json& value) {
  if (value.is_number()) return number_fault(key, value);
  return word_fault(key, value).empty()
             ? ""
             : is_but_must_be(value, "a number or " + join(key.words, ", "));
}

std::string text_fault(const json& value) {
  if (!value.is_string()) return is_but_must_be(value, "a text");
  const auto& text = value.get_ref<const std::string&>();
  if (text.empty()) return "is empty";
  const bool has_controls =
      std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20; });
  return has_controls ? is_but_must_be(value, "a text without control characters") : "";
}

std::optional<Fault> at_place(const std::string& place, const std::string& words) {
  if (words.empty()) return std::nullopt;
  return Fault{place, words};
}

std::string at(std::size_t index) { return "[" + std::to_string(index) + "]"; }

std::optional<Fault> numbers_fault(const SceneKey& key, const json& value) {
  if (!value.is_array())
    return Fault{"", is_but_must_be(value, "a list of " + std::to_string(key.count) + " numbers")};
  if (value.size() != static_cast<std::size_t>(key.count))
    return Fault{"", "has " + std::to_string(value.size()) +
                         (value.size() == 1 ? " member" : " members") + ", but must have " +
                         std::to_string(key.count)};
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (const std::string words = number_fault(key, value[i]); !words.empty())
      return Fault{at(i), words};
  }
  return std::nullopt;
}

std::optional<Fault> too_many(const SceneKey& key, const json& value, const std::string& what) {
  if (value.size() <= static_cast<std::size_t>(key.count)) return std::nullopt;
  return Fault{"", "has " + std::to_string(value.size()) + " " + what + ", but may have at most " +
                       std::to_string(key.count)};
}

std::optional<Fault> points_fault(const SceneKey& key, const json& value) {
  const bool are_balls = key.kind == ValueKind::Balls;
  if (!value.is_array())
    return Fault{"", is_but_must_be(value, are_balls ? "a list of balls [x, y, z, radius]"
                                                     : "a list of points [x, y, z]")};
  if (auto fault = too_many(key, value, are_balls ? "balls" : "points")) return fault;
  SceneKey point = key;
  point.kind = ValueKind::Numbers;
  point.count = are_balls ? 4 : 3;
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (const auto fault = numbers_fault(point, value[i]))
      return Fault{at(i) + fault->place, fault->words};
    if (are_balls && value[i][3].get<double>() <= 0.0)
      return Fault{at(i) + at(3), is_but_must_be(value[i][3], "a radius above 0")};
  }
  return std::nullopt;
}

/// What the values of a shape must be to each other.
std::optional<Fault> shape_fault(const json& shape) {
  if (shape["shape"] == "horseshoe" &&
      shape["half_width_mm"].get<double>() >= shape["arc_radius_mm"].get<double>())
    return Fault{".half_width_mm",
                 is_but_must_be(shape["half_width_mm"],
                                "below arc_radius_mm, " + shown(shape["arc_radius_mm"]))};
  if (shape["shape"] == "polygon" && shape["points_mm"].size() < 3)
    return Fault{".points_mm", "has " + std::to_string(shape["points_mm"].size()) +
                                   " points, but must have at least 3"};
  return std::nullopt;
}

std::optional<Fault> tumour_fault(const json& shape) {
  if (!shape.is_object() || !shape.contains("shape"))
    return Fault{"", "must be an object with a \"shape\""};
  if (!shape["shape"].is_string() || std::count(tumour_shapes().begin(), tumour_shapes().end(),
                                                shape["shape"].get<std::string>()) == 0)
    return Fault{".shape", is_but_must_be(shape["shape"], "one of " + join(tumour_shapes(), ", "))};
  const std::string name = shape["shape"];
  const std::vector<SceneKey>& keys = tumour_keys(name);
  for (auto member = shape.begin(); member != shape.end(); ++member) {
    if (member.key() == "shape") continue;
    const auto known = std::find_if(keys.begin(), keys.end(),
                                    [&](const SceneKey& one) { return one.path == member.key(); });
    const std::string place = "." + shown_key(member.key());
    if (known == keys.end())
      return Fault{place, "is not a key of a " + name + "; the nearest is " +
                              nearest_key(member.key(), keys)};
    if (const auto fault = fault_of(*known, member.value()))
      return Fault{place + fault->place, fault->words};
  }
  for (const SceneKey& key : keys) {
    if (key.standard.is_null() && !shape.contains(key.path))
      return Fault{"." + key.path, "is missing: a " + name + " needs it (" + key.meaning + ")"};
  }
  return shape_fault(shape);
}

std::optional<Fault> tumours_fault(const SceneKey& key, const json& value) {
  if (!value.is_array()) return Fault{"", is_but_must_be(value, "a list of shapes")};
  if (auto fault = too_many(key, value, "shapes")) return fault;
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (const auto fault = tumour_fault(value[i])) return Fault{at(i) + fault->place, fault->words};
  }
  return std::nullopt;
}

std::string last_name(const std::string& path) { return path.substr(path.rfind('.') + 1); }

}  // namespace

json::json_pointer pointer_to(const std::string& path) {
  std::string pointer = "/" + path;
  std::replace(pointer.begin(), pointer.end(), '.', '/');
  return json::json_pointer(pointer);
}

std::optional<Fault> fault_of(const SceneKey& key, const json& value) {
  switch (key.kind) {
    case ValueKind::Number:
    case ValueKind::Integer:
      return at_place("", number_fault(key, value));
    case ValueKind::Truth:
      return at_place("", value.is_boolean() ? "" : is_but_must_be(value, "true or false"));
    case ValueKind::Word:
      return at_place("", word_fault(key, value));
    case ValueKind::NumberOrWord:
      return at_place("", number_or_word_fault(key, value));
    case ValueKind::Text:
      return at_place("", text_fault(value));
    case ValueKind::Numbers:
    case ValueKind::Integers:
      return numbers_fault(key, value);
    case ValueKind::Points:
    case ValueKind::Balls:
      return points_fault(key, value);
    case ValueKind::Tumours:
      return tumours_fault(key, value);
  }
  return std::nullopt;
}

std::string nearest_key(const std::string& unknown, const std::vector<SceneKey>& keys) {
  const std::string sought = unknown.substr(0, kLongestKey);
  std::string nearest;
  int least = 0;
  const auto consider = [&](const std::string& known) {
    const int distance = std::min(edit_distance(sought, known),
                                  1 + edit_distance(last_name(sought), last_name(known)));
    if (!nearest.empty() && distance >= least) return;
    nearest = known;
    least = distance;
  };
  for (const SceneKey& key : keys) {
    consider(key.path);
    for (std::size_t dot = key.path.find('.'); dot != std::string::npos;
         dot = key.path.find('.', dot + 1)) {
      if (!sought.starts_with(key.path.substr(0, dot + 1))) consider(key.path.substr(0, dot));
    }
  }
  return nearest;
}

}  // namespace palpation::tool
