/// Numbers as text in files: independent of the locale, and never cut short in silence.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace palpation {

enum class NumberStatus { Fine, NotANumber, TooLarge, Underflow };

struct ParsedNumber {
  double value = 0.0;  ///< 0 where the number is too small for a double
  NumberStatus status = NumberStatus::NotANumber;
};

/// The whole word as a double, correctly rounded; "nan" and "inf" are numbers here. A leading plus
/// is welcome.
ParsedNumber parse_number(std::string_view word);

/// The whole word as an integer; nothing if it is none, or none that fits.
std::optional<std::int64_t> parse_integer(std::string_view word);

/// A length in metres for a message: to the micrometre, unless that leaves nothing of it.
std::string length_text(double length_m);

/// A word for a message: in quotes, control characters replaced, cut after 40 characters.
std::string in_quotes(std::string_view word);

}  // namespace palpation
