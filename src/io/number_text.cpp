#include "io/number_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "palpation/base/error.h"

namespace palpation {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view without_plus(std::string_view word) {
  const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+';
  return plus ? word.substr(1) : word;
}

std::string_view mantissa_of(std::string_view word) {
  return word.substr(0, word.find_first_of("eE"));
}

bool has_nonzero_digit(std::string_view word) {
  const std::string_view mantissa = mantissa_of(word);
  return std::any_of(mantissa.begin(), mantissa.end(), [](char c) { return c >= '1' && c <= '9'; });
}

/// Decimal exponent of the first digit that is not zero: from_chars reports too large and too small
/// alike.
std::int64_t magnitude_of(std::string_view word) {
  const std::string_view mantissa = mantissa_of(word);
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  const std::size_t leading = mantissa.find_first_of("123456789");
  const auto place = leading < point ? static_cast<std::int64_t>(point - leading) - 1
                                     : -static_cast<std::int64_t>(leading - point);
  if (mantissa.size() == word.size()) return place;
  const std::string_view exponent = without_plus(word.substr(mantissa.size() + 1));
  std::int64_t value = 0;
  const auto [end, status] =
      std::from_chars(exponent.data(), exponent.data() + exponent.size(), value);
  if (status == std::errc::result_out_of_range)
    return exponent[0] == '-' ? std::numeric_limits<std::int64_t>::min() / 2
                              : std::numeric_limits<std::int64_t>::max() / 2;
  return std::clamp(value, std::numeric_limits<std::int64_t>::min() / 2,
                    std::numeric_limits<std::int64_t>::max() / 2) +
         place;
}

}  // namespace

ParsedNumber parse_number(std::string_view word) {
  const std::string_view text = without_plus(word);
  double value = 0.0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || status == std::errc::invalid_argument)
    return {0.0, NumberStatus::NotANumber};
  const bool spelled_number = std::any_of(text.begin(), text.end(), is_digit);
  if (status == std::errc::result_out_of_range || (spelled_number && std::isinf(value))) {
    if (magnitude_of(text) > 0) return {value, NumberStatus::TooLarge};
    return {0.0, NumberStatus::Underflow};
  }
  if (value == 0.0 && has_nonzero_digit(text)) return {0.0, NumberStatus::Underflow};
  return {value, NumberStatus::Fine};
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
  const std::string_view text = without_plus(word);
  std::int64_t value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || status != std::errc{}) return std::nullopt;
  return value;
}

std::string length_text(double length_m) {
  const double rounded = std::round(length_m * 1e6) / 1e6;
  return text_of(rounded != 0.0 ? rounded : length_m);
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  std::string text = "\"";
  for (const char c : word.substr(0, kLongest))
    text += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return text + (word.size() > kLongest ? "...\"" : "\"");
}

}  // namespace palpation
