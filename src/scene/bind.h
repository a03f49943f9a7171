/// From a member of some options to the key of a scene that sets it (bound_keys.h): units, words,
/// and how each kind of member is told and taken.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "palpation/base/learnable.h"
#include "scene/bound_keys.h"

namespace palpation::tool {

/// Of a key: a value times `times` over `over` is in SI units.
struct Unit {
  double times = 1.0, over = 1.0;
};
inline constexpr Unit kAsIs{};
inline constexpr Unit kMillimetres{1.0, 1e3}, kSquareMillimetres{1.0, 1e6}, kMilliseconds{1.0, 1e3};
inline constexpr Unit kNewtonsPerMillimetre{1e3, 1.0}, kDegrees{std::numbers::pi, 180.0};

/// A default is a short number in its key's unit, whatever the conversion rounds.
inline nlohmann::json told(double value, Unit unit) {
  if (!std::isfinite(value)) return nullptr;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.12g", value * unit.over / unit.times);
  return std::strtod(text.data(), nullptr);
}
inline nlohmann::json told(const Learnable& value, Unit unit) {
  return value.is_learned() ? nlohmann::json("learn") : told(*value.given(), unit);
}
inline nlohmann::json told(const std::optional<double>& value, Unit unit) {
  return value ? told(*value, unit) : nlohmann::json(nullptr);
}
inline nlohmann::json told(const std::string& text, Unit) {
  return text.empty() ? nlohmann::json(nullptr) : nlohmann::json(text);
}
inline nlohmann::json told(const Eigen::Matrix4d& rows, Unit) {
  nlohmann::json list = nlohmann::json::array();
  for (int i = 0; i < 16; ++i) {
    const double number = rows(i / 4, i % 4);
    const bool is_whole = number == std::round(number) && std::abs(number) < 1e9;
    list.push_back(is_whole ? nlohmann::json(static_cast<int>(number)) : nlohmann::json(number));
  }
  return list;
}
template <typename Whole>  // a number, or true or false
nlohmann::json told(const Whole& value, Unit) {
  return value;
}

inline void take(double& member, const nlohmann::json& value, Unit unit) {
  member = value.get<double>() * unit.times / unit.over;
}
inline void take(Learnable& member, const nlohmann::json& value, Unit unit) {
  if (value.is_string()) {
    member = kLearned;
  } else {
    double number = 0.0;
    take(number, value, unit);
    member = number;
  }
}
inline void take(std::optional<double>& member, const nlohmann::json& value, Unit unit) {
  take(member.emplace(), value, unit);
}
inline void take(std::string& member, const nlohmann::json& value, Unit) {
  member = value.get<std::string>();
}
inline void take(Eigen::Matrix4d& rows, const nlohmann::json& value, Unit) {
  for (int i = 0; i < 16; ++i) rows(i / 4, i % 4) = value[i].get<double>();
}
inline void take(bool& member, const nlohmann::json& value, Unit) { member = value.get<bool>(); }
template <typename Whole>
void take(Whole& member, const nlohmann::json& value, Unit) {
  member = static_cast<Whole>(value.get<double>());
}

template <typename Value>
using Words = std::vector<std::pair<std::string, Value>>;

template <typename Value>
std::vector<std::string> names_of(const Words<Value>& words) {
  std::vector<std::string> names;
  for (const auto& [name, value] : words) names.push_back(name);
  return names;
}

/// A member of a member of ... of the options.
template <typename Object, typename First, typename... Rest>
auto& within(Object& object, First first, Rest... rest) {
  if constexpr (sizeof...(rest) == 0) {
    return object.*first;
  } else {
    return within(object.*first, rest...);
  }
}

/// Binds keys to members of these options.
template <typename Options>
struct Bind {
  template <typename... Members>
  static BoundKey<Options> to(std::string path, Unit unit, Members... members) {
    return {std::move(path),
            [=](const Options& options) { return told(within(options, members...), unit); },
            [=](Options& options, const nlohmann::json& value) {
              take(within(options, members...), value, unit);
            }};
  }

  /// The same of a number that says nothing where it is 0.
  template <typename... Members>
  static BoundKey<Options> if_any(std::string path, Unit unit, Members... members) {
    BoundKey<Options> key = to(std::move(path), unit, members...);
    key.told = [=](const Options& options) {
      const double value = within(options, members...);
      return value == 0.0 ? nlohmann::json() : told(value, unit);
    };
    return key;
  }

  template <typename Value, typename... Members>
  static BoundKey<Options> word(std::string path, Words<Value> words, Members... members) {
    return {std::move(path),
            [=](const Options& options) -> nlohmann::json {
              for (const auto& [name, value] : words)
                if (value == within(options, members...)) return name;
              return nullptr;
            },
            [=](Options& options, const nlohmann::json& given) {
              for (const auto& [name, value] : words)
                if (name == given) within(options, members...) = value;
            },
            names_of(words)};
  }
};

}  // namespace palpation::tool
