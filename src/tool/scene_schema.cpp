#include "tool/scene_schema.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "palpation/base/error.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr double kAny = 1e300;
constexpr double kMostLength_mm = 1e6;
constexpr double kLeastLength_mm = 1e-6;

SceneKey number(std::string path, std::string unit, double least, double most, json standard, std::string meaning) {
  return {std::move(path), ValueKind::Number, std::move(unit), least, most, {}, 0, std::move(standard), std::move(meaning)};
}

SceneKey integer(std::string path, double least, double most, json standard, std::string meaning) {
  return {std::move(path), ValueKind::Integer, "", least, most, {}, 0, std::move(standard), std::move(meaning)};
}

SceneKey truth(std::string path, bool standard, std::string meaning) {
  return {std::move(path), ValueKind::Truth, "", 0.0, 0.0, {}, 0, standard, std::move(meaning)};
}

SceneKey word(std::string path, std::vector<std::string> words, json standard, std::string meaning) {
  return {std::move(path), ValueKind::Word, "", 0.0, 0.0, std::move(words), 0, std::move(standard), std::move(meaning)};
}

SceneKey number_or_learn(std::string path, std::string unit, double least, double most, std::string meaning) {
  return {std::move(path), ValueKind::NumberOrWord, std::move(unit), least, most, {"learn"}, 0, "learn", std::move(meaning)};
}

SceneKey text(std::string path, std::string meaning) {
  return {std::move(path), ValueKind::Text, "", 0.0, 0.0, {}, 0, nullptr, std::move(meaning)};
}

SceneKey numbers(std::string path, int count, std::string unit, double least, double most, json standard, std::string meaning) {
  return {std::move(path), ValueKind::Numbers, std::move(unit), least, most, {}, count, std::move(standard), std::move(meaning)};
}

std::vector<SceneKey> make_scene_keys() {
  const json identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  return {
      integer("version", 1, 1, 1, "of this format"),
      text("surface.mesh", "the tissue: an OBJ, OFF, STL, PLY or VTP file, relative to the scene"),
      word("surface.unit", {"mm", "cm", "m"}, nullptr, "of the mesh's coordinates; needed with surface.mesh"),
      numbers("surface.plane.size_mm", 2, "mm", kLeastLength_mm, kMostLength_mm, nullptr,
              "in place of a mesh: a flat rectangle from the origin, along x and y"),
      numbers("surface.plane.vertices", 2, "", 2, 20000, json{200, 200}, "of that rectangle, along x and y"),
      number("surface.refine_mm", "mm", kLeastLength_mm, kMostLength_mm, nullptr, "split triangles until no edge is longer"),
      numbers("surface.patch.centre_mm", 3, "mm", -kMostLength_mm, kMostLength_mm, nullptr,
              "work on the tissue around the surface point nearest to this"),
      number("surface.patch.radius_mm", "mm", kLeastLength_mm, kMostLength_mm, nullptr,
             "and no farther from it, walking along the surface"),
      word("field.metric", {"chart", "ambient"}, "chart", "distance between places: in the chart, or straight through space"),
      word("field.kernel", {"squared-exponential", "matern-1/2", "matern-3/2", "matern-5/2", "periodic"}, "squared-exponential",
           "covariance of the stiffness at two places"),
      number_or_learn("field.length_mm", "mm", kLeastLength_mm, kMostLength_mm, "over which stiffness changes"),
      number_or_learn("field.signal_sd", "reading", 1e-150, 1e150,
                      "prior standard deviation of the stiffness; a fixed value with standardize: multiples of the readings' own"),
      number_or_learn("field.noise", "reading", 0.0, 1e150, "standard deviation of a reading"),
      number("field.noise_to_signal", "", 0.0, 1e6, nullptr, "in place of field.noise: the same as a fraction of a fixed signal_sd"),
      number("field.length_prior_mm", "mm", kLeastLength_mm, kMostLength_mm, 3.5,
             "what a learned length is likely to be: the median of a lognormal prior (spread 0.4)"),
      number("field.period_mm", "mm", kLeastLength_mm, kMostLength_mm, nullptr, "period of the periodic kernel, the same along both axes"),
      word("field.trend", {"zero", "constant"}, "constant", "mean of the field before any reading"),
      number("field.constant_sd", "reading", 0.0, 1e150, nullptr,
             "how well that constant is known beforehand (as signal_sd); left out: not at all"),
      truth("field.standardize", true,
            "readings are z-scored, as GPy does; where anything is learned it matters only to a trend of zero, which is then about their "
            "mean"),
      word("level.estimate", {"known", "range"}, "range",
           "where tissue becomes tumour: known beforehand, or min + fraction (max - min) of the mean"),
      number("level.fraction", "", 1e-6, 1.0 - 1e-6, 0.5, "of that range; it also defines the true outline of a simulated tumour"),
      number("level.value", "reading", -kAny, kAny, nullptr, "the level, if it is known"),
      word("plan.acquisition", {"ils-ucb", "ucb", "evr", "straddle", "lse", "random", "raster", "refinement"}, "ils-ucb",
           "what makes a touch worth while; raster and refinement are the classical scans instead"),
      number("plan.gamma", "", 0.0, 1.0, 0.5, "of ucb and ils-ucb: 0 explores, 1 exploits"),
      word("plan.scaling", {"raw", "max"}, "raw", "of ucb and ils-ucb: as the paper writes them, or both terms over their maxima"),
      word("plan.initial.design", {"grid", "random", "low-discrepancy"}, "grid", "the first touches"),
      integer("plan.initial.count", 0, 100000, 16, "how many of them"),
      integer("plan.batch", 1, 100000, 10, "touches planned together"),
      integer("plan.batches", 0, 100000, 9, "how many batches after the first touches"),
      number("plan.least_spacing_mm", "mm", 0.0, kMostLength_mm, 0.5, "between the stops of a batch"),
      truth("plan.readings_along_path", false, "the probe also reads on its way, once per mm"),
      truth("plan.safe_start", true,
            "explore by variance alone until the readings show contrast beyond their noise; matters only where the field is learned"),
      number("plan.stop.expected_error_mm2", "mm2", 0.0, kAny, 0.0,
             "stop once the expected wrong area is no larger; 0: when the batches are done"),
      number("plan.row_spacing_mm", "mm", 0.01, kMostLength_mm, 2.0,
             "of a raster scan's rows, and the coarsest cells of a refinement: four times this"),
      word("probe.kind", {"simulated"}, "simulated", "where readings come from in `palpate simulate`"),
      number("probe.low", "reading", -kAny, kAny, 7.0, "simulated reading on healthy tissue"),
      number("probe.high", "reading", -kAny, kAny, 9.0, "simulated reading deep inside a tumour; above probe.low"),
      number("probe.slope_per_m", "1/m", 1e-3, 1e9, 1400.0, "steepness of the edge between them"),
      number("probe.noise", "", 0.0, 1e6, 0.0, "standard deviation, as a fraction of high - low"),
      number("probe.bias", "", -1e6, 1e6, 0.0,
             "the paper's beta: what is added from one end of the tissue to the other, as a fraction of high - low"),
      numbers("probe.bias_axis", 3, "", -kAny, kAny, nullptr, "along which; left out: the longest side of the tissue"),
      {"probe.tumours", ValueKind::Tumours, "", 0.0, 0.0, {}, 0, json::array(), "a list of shapes"},
      numbers("robot.from_tissue", 16, "", -kAny, kAny, identity,
              "rigid transform to the robot's frame, row by row, its translation in metres"),
      number("robot.standoff_mm", "mm", 0.0, 1000.0, 5.0, "of the approach point, above the tissue"),
      number("robot.indent_mm", "mm", 0.0, 100.0, 2.0, "how deep the probe presses"),
      integer("seed", 0, 9007199254740992.0, 1, "of all that is random"),
  };
}

std::string join(const std::vector<std::string>& words, const std::string& between) {
  std::string result;
  for (const std::string& one : words) result += (result.empty() ? "" : between) + one;
  return result;
}

std::string range_text(const SceneKey& key) {
  if (key.least <= -kAny && key.most >= kAny) return "any number";
  if (key.most >= kAny) return "at least " + text_of(key.least);
  return text_of(key.least) + " to " + text_of(key.most);
}

std::string number_fault(const SceneKey& key, const json& value) {
  if (!value.is_number()) return "is " + value.dump().substr(0, 60) + ", but must be a number";
  const double number = value.get<double>();
  if (!std::isfinite(number)) return "must be finite";
  if (number < key.least || number > key.most)
    return "is " + text_of(number) + ", but must be " + range_text(key) + (key.unit.empty() ? "" : " " + key.unit);
  return "";
}

std::string word_fault(const SceneKey& key, const json& value) {
  if (value.is_string() && std::find(key.words.begin(), key.words.end(), value.get<std::string>()) != key.words.end()) return "";
  return "is " + value.dump().substr(0, 60) + ", but must be " + (key.words.size() > 1 ? "one of " : "") + join(key.words, ", ");
}

std::string tumours_fault(const json& value) {
  if (!value.is_array()) return "must be a list of shapes";
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::string at = "[" + std::to_string(i) + "]";
    const json& shape = value[i];
    if (!shape.is_object() || !shape.contains("shape") || !shape["shape"].is_string()) return at + " must be an object with a \"shape\"";
    const std::string name = shape["shape"];
    if (std::find(tumour_shapes().begin(), tumour_shapes().end(), name) == tumour_shapes().end()) {
      return at + ".shape is \"" + name + "\", but must be one of " + join(tumour_shapes(), ", ");
    }
    const std::vector<SceneKey>& keys = tumour_keys(name);
    for (const auto& [key, member] : shape.items()) {
      if (key == "shape") continue;
      const auto known = std::find_if(keys.begin(), keys.end(), [&](const SceneKey& one) { return one.path == key; });
      if (known == keys.end()) return at + "." + key + " is not a key of a " + name + "; the nearest is " + nearest_key(key, keys);
      if (const std::string fault = fault_of(*known, member); !fault.empty()) return at + "." + key + " " + fault;
    }
    for (const SceneKey& key : keys) {
      if (key.standard.is_null() && !shape.contains(key.path)) return at + " (" + name + ") lacks " + key.path;
    }
  }
  return "";
}

int edit_distance(const std::string& a, const std::string& b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({substituted, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
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
      values = key.count > 0 ? std::to_string(key.count) + " numbers" : "a list of [x, y, z]";
      break;
    case ValueKind::Tumours:
      values = "a list of " + join(tumour_shapes(), ", ");
      break;
  }
  out << indent << key.path;
  if (!key.unit.empty()) out << " [" << key.unit << "]";
  out << "\n" << indent << "    " << key.meaning << "\n" << indent << "    " << values;
  if (!key.standard.is_null()) out << "; default " << key.standard.dump();
  out << "\n";
}

}  // namespace

const std::vector<SceneKey>& scene_keys() {
  static const std::vector<SceneKey> keys = make_scene_keys();
  return keys;
}

const std::vector<std::string>& tumour_shapes() {
  static const std::vector<std::string> shapes = {"disk", "horseshoe", "polygon"};
  return shapes;
}

const std::vector<SceneKey>& tumour_keys(const std::string& shape) {
  static const SceneKey centre =
      numbers("centre_mm", 3, "mm", -kMostLength_mm, kMostLength_mm, nullptr, "in the mesh's frame, taken to the closest surface point");
  static const std::vector<SceneKey> disk = {centre,
                                             number("radius_mm", "mm", kLeastLength_mm, kMostLength_mm, nullptr, "along the surface")};
  static const std::vector<SceneKey> horseshoe = {
      centre,
      number("arc_radius_mm", "mm", kLeastLength_mm, kMostLength_mm, nullptr, "of the middle line"),
      number("half_width_mm", "mm", kLeastLength_mm, kMostLength_mm, nullptr, "on both sides of it, with round caps"),
      number("arc_deg", "degrees", 1e-3, 360.0, 180.0, "the solid part"),
      numbers("facing", 3, "", -kAny, kAny, json{1, 0, 0}, "from the centre to the middle of the arc"),
  };
  static const std::vector<SceneKey> polygon = {{"points_mm",
                                                 ValueKind::Numbers,
                                                 "mm",
                                                 -kMostLength_mm,
                                                 kMostLength_mm,
                                                 {},
                                                 0,
                                                 nullptr,
                                                 "corners, each [x, y, z]; the last may repeat the first"}};
  return shape == "disk" ? disk : shape == "horseshoe" ? horseshoe : polygon;
}

std::string fault_of(const SceneKey& key, const json& value) {
  switch (key.kind) {
    case ValueKind::Number:
      return number_fault(key, value);
    case ValueKind::Integer:
      if (value.is_number() && value.get<double>() != std::floor(value.get<double>()))
        return "is " + value.dump() + ", but must be a whole number";
      return number_fault(key, value);
    case ValueKind::Truth:
      return value.is_boolean() ? "" : "is " + value.dump().substr(0, 60) + ", but must be true or false";
    case ValueKind::Word:
      return word_fault(key, value);
    case ValueKind::NumberOrWord:
      if (value.is_number()) return number_fault(key, value);
      if (word_fault(key, value).empty()) return "";
      return "is " + value.dump().substr(0, 60) + ", but must be a number or " + join(key.words, ", ");
    case ValueKind::Text:
      return value.is_string() ? "" : "is " + value.dump().substr(0, 60) + ", but must be a text";
    case ValueKind::Numbers: {
      if (!value.is_array()) return "must be a list";
      if (key.count == 0) {
        SceneKey point = key;
        point.count = 3;
        for (const json& one : value) {
          if (const std::string fault = fault_of(point, one); !fault.empty()) return "holds a point that " + fault;
        }
        return "";
      }
      if (static_cast<int>(value.size()) != key.count)
        return "has " + std::to_string(value.size()) + " members, but must have " + std::to_string(key.count);
      for (const json& one : value) {
        if (const std::string fault = number_fault(key, one); !fault.empty()) return "holds a member that " + fault;
      }
      return "";
    }
    case ValueKind::Tumours:
      return tumours_fault(value);
  }
  return "";
}

std::string nearest_key(const std::string& unknown, const std::vector<SceneKey>& keys) {
  const auto nearest = std::min_element(keys.begin(), keys.end(), [&](const SceneKey& a, const SceneKey& b) {
    return edit_distance(unknown, a.path) < edit_distance(unknown, b.path);
  });
  return nearest == keys.end() ? "" : nearest->path;
}

std::string scene_help() {
  std::ostringstream out;
  out << "A scene is a JSON file. Its keys, in groups: \"surface\": { \"mesh\": ... } is written surface.mesh here and in --set.\n"
      << "Lengths are millimetres where a key says so; \"reading\" is the sensor's own unit. Paths are relative to the scene.\n\n";
  std::string group;
  for (const SceneKey& key : scene_keys()) {
    const std::string here = key.path.substr(0, key.path.find('.'));
    if (here != group && !group.empty()) out << "\n";
    group = here;
    describe(out, key, "");
  }
  for (const std::string& shape : tumour_shapes()) {
    out << "\nA tumour with \"shape\": \"" << shape << "\"\n";
    for (const SceneKey& key : tumour_keys(shape)) describe(out, key, "    ");
  }
  return out.str();
}

}  // namespace palpation::tool
