/// A scene: what a JSON file says, checked against the schema, every default filled in.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpation/base/types.h"

namespace palpation::tool {

class Scene {
 public:
  /// `name` stands for the scene in messages; relative paths in it are relative to `folder`. Throws
  /// IoError naming scene, key, value and rule.
  Scene(const nlohmann::json& given, std::string name, std::filesystem::path folder);

  /// Reads the file and overrides single values: each text is "path=value", each path given once.
  /// Throws IoError.
  static Scene read(const std::filesystem::path& path, std::span<const std::string> overrides);
  /// The same from a text.
  static Scene parse(std::string_view text, std::string name, std::filesystem::path folder,
                     std::span<const std::string> overrides = {});

  /// The same scene with one value changed.
  Scene with(const std::string& path, const nlohmann::json& value) const;
  /// The same scene with values changed as by read().
  Scene with_overrides(std::span<const std::string> overrides) const;

  bool has(const std::string& path) const;    ///< given, or with a default
  bool gives(const std::string& path) const;  ///< given
  /// Given, or by default; throws IoError, which says what the key means, where there is neither.
  const nlohmann::json& value(const std::string& path) const;
  double number(const std::string& path) const;
  int integer(const std::string& path) const;
  std::uint64_t seed() const;
  bool truth(const std::string& path) const;
  std::string word(const std::string& path)
      const;  ///< of a Word or Text; of a NumberOrWord if it is a word, else empty
  std::vector<double> numbers(const std::string& path) const;
  double metres(const std::string& path) const;  ///< of a key in millimetres
  Vec3 point_m(const std::string& path) const;   ///< of three millimetres
  /// Of a list of points or balls, in millimetres.
  std::vector<std::vector<double>> points_mm(const std::string& path) const;
  const nlohmann::json& tumours() const;

  const std::string& name() const { return name_; }
  const std::filesystem::path& folder() const { return folder_; }
  /// All keys, defaults included: what summary.json records.
  nlohmann::json complete() const;
  /// Only what was given: what --print-scene prints.
  const nlohmann::json& given() const { return given_; }
  /// Values that were given but have no effect, and keys under an old name, a sentence each.
  std::vector<std::string> warnings() const;

  /// Throws IoError about a key: "<scene>: <path>: <words>".
  [[noreturn]] void refuse(const std::string& path, const std::string& words) const;
  /// The same about a key's value: "<scene>: <path>: is <value>, but must be <rule>".
  [[noreturn]] void refuse_value(const std::string& path, const std::string& rule) const;

 private:
  const nlohmann::json* value_of_speed(const std::string& path) const;
  void check_members(const nlohmann::json& object, const std::string& prefix) const;
  void check_together() const;
  Scene with_given(const nlohmann::json& given) const;

  nlohmann::json given_;  ///< as the schema spells it
  std::vector<std::string> remarks_;
  std::string name_;
  std::filesystem::path folder_;
};

}  // namespace palpation::tool
