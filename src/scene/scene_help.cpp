// What `palpate help scene` prints.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "palpation/base/error.h"
#include "scene/scene_schema.h"

namespace palpation::tool {
namespace {

std::string join(const std::vector<std::string>& words, const std::string& between) {
  std::string result;
  for (const std::string& one : words) result += (result.empty() ? "" : between) + one;
  return result;
}

/// A number as a person writes it: 100000, not 1e+05.
std::string plain(double value) {
  const bool is_short_whole = value == std::floor(value) && std::abs(value) <= 9007199254740991.0;
  return is_short_whole ? std::to_string(static_cast<long long>(value)) : text_of(value);
}

void describe(std::ostringstream& out, const SceneKey& key, const std::string& indent) {
  std::string values;
  switch (key.kind) {
    case ValueKind::Number:
      values = range_text(key);
      break;
    case ValueKind::Integer:
      values = "whole number, " + range_text(key);
      break;
    case ValueKind::Truth:
      values = "true or false";
      break;
    case ValueKind::Word:
      values = join(key.words, " | ");
      break;
    case ValueKind::NumberOrWord:
      values = join(key.words, " | ") + " | " + range_text(key);
      break;
    case ValueKind::Text:
      values = "text";
      break;
    case ValueKind::Numbers:
      values = std::to_string(key.count) + " numbers, " + range_text(key);
      break;
    case ValueKind::Integers:
      values = std::to_string(key.count) + " whole numbers, " + range_text(key);
      break;
    case ValueKind::Points:
      values = "a list of at most " + std::to_string(key.count) + " points [x, y, z]";
      break;
    case ValueKind::Balls:
      values = "a list of at most " + std::to_string(key.count) + " balls [x, y, z, radius]";
      break;
    case ValueKind::Tumours:
      values =
          "a list of at most " + std::to_string(key.count) + " of " + join(tumour_shapes(), ", ");
      break;
  }
  out << indent << key.path;
  if (!key.unit.empty()) out << " [" << key.unit << "]";
  out << "\n" << indent << "    " << key.meaning << "\n" << indent << "    " << values;
  if (!key.standard.is_null()) out << "; default " << key.standard.dump();
  out << "\n";
}

void describe_shape(std::ostringstream& out, const std::string& shape) {
  out << "\nA tumour with \"shape\": \"" << shape << "\"\n";
  for (const SceneKey& key : tumour_keys(shape)) describe(out, key, "    ");
}

}  // namespace

std::string range_text(const SceneKey& key) {
  const std::string range =
      key.least == key.most ? plain(key.least) : plain(key.least) + " to " + plain(key.most);
  return (key.zero_too ? "0, or " : "") + range;
}

std::string key_help(const std::string& path) {
  std::ostringstream out;
  for (const SceneKey& key : scene_keys()) {
    if (key.path != path && !key.path.starts_with(path + ".")) continue;
    describe(out, key, "");
    if (key.kind != ValueKind::Tumours) continue;
    for (const std::string& shape : tumour_shapes()) describe_shape(out, shape);
  }
  return out.str();
}

std::string scene_help() {
  std::ostringstream out;
  out << "A scene is a JSON file. Its keys, in groups: \"surface\": { \"mesh\": ... } is written "
         "surface.mesh here and in --set,\n"
      << "which sets a list as a whole, and takes a key away with null.\n"
      << "Lengths are millimetres where a key says so; \"reading\" is the sensor's own unit. Paths "
         "are relative to the scene.\n\n";
  std::string group;
  for (const SceneKey& key : scene_keys()) {
    const std::string here = key.path.substr(0, key.path.find('.'));
    if (here != group && !group.empty()) out << "\n";
    group = here;
    describe(out, key, "");
  }
  for (const std::string& shape : tumour_shapes()) describe_shape(out, shape);
  return out.str();
}

}  // namespace palpation::tool
