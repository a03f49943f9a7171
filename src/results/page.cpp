#include "results/page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "palpation/base/error.h"

namespace palpation::results {
namespace {

constexpr std::string_view kNotShown = "\xEF\xBF\xBD";  // U+FFFD

/// How many bytes a character in UTF-8 has that begins here; 0 where none does.
std::size_t length_of_character(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 && first < 0xF5   ? 4
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xC2 && first < 0xE0 ? 2
                                                             : 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  const bool is_too_long = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
  const bool is_surrogate = first == 0xED && byte(1) >= 0xA0;
  const bool is_beyond = first == 0xF4 && byte(1) >= 0x90;
  return is_too_long || is_surrogate || is_beyond ? 0 : length;
}

std::string_view reference_of(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = length_of_character(text);
    const char first = text.front();
    const bool is_control =
        length == 1 &&
        (first == 0x7F || (first >= 0 && first < 0x20 && first != '\n' && first != '\t'));
    if (length == 0 || is_control) {
      result += kNotShown;
    } else if (const std::string_view reference = reference_of(first); !reference.empty()) {
      result += reference;
    } else {
      result += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

std::string inert(std::string json) {
  std::string result;
  result.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      result += "\\u003c";
    } else if (c == '>') {
      result += "\\u003e";
    } else if (c == '&') {
      result += "\\u0026";
    } else {
      result += c;
    }
  }
  return result;
}

std::string rounded(double value, int digits) {
  if (!std::isfinite(value)) return "\u2013";
  if (value == 0.0) return "0";
  const int size = static_cast<int>(std::floor(std::log10(std::abs(value))));
  const bool is_whole = value == std::floor(value) && size < digits;
  const int decimals = is_whole ? 0 : std::clamp(digits - 1 - size, 0, 12);
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

std::string shown(const std::optional<double>& value, int digits, const std::string& key) {
  if (!value || !std::isfinite(*value)) return "\u2013";
  return "<data" + (key.empty() ? std::string() : " data-key=\"" + escaped(key) + "\"") +
         " value=\"" + text_of(*value) + "\">" + rounded(*value, digits) + "</data>";
}

}  // namespace palpation::results
