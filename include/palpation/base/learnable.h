/// A number that is given, or that the readings are to teach.
///
///     KernelModel{.length_m = 0.004, .signal_sd = kLearned}
#pragma once

#include <optional>

namespace palpation {

struct ByReadings {};
/// In place of a value: the readings teach it.
inline constexpr ByReadings kLearned{};

class Learnable {
 public:
  constexpr Learnable(double value) : value_(value) {}
  constexpr Learnable(ByReadings) {}

  constexpr bool is_learned() const { return !value_.has_value(); }
  /// What is given; nothing where it is learned.
  constexpr const std::optional<double>& given() const { return value_; }
  /// What is given, or what stands in for it until it is learned.
  constexpr double value_or(double other) const { return value_.value_or(other); }
  constexpr bool operator==(const Learnable&) const = default;

 private:
  std::optional<double> value_;
};

}  // namespace palpation
