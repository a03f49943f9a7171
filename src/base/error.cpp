#include "palpation/base/error.h"

#include <array>
#include <charconv>

namespace palpation {

void require(bool condition, const std::string& function, const std::string& value,
             const std::string& rule) {
  if (!condition) throw InvalidInput(function + ": " + value + " " + rule);
}

std::string text_of(double value) {
  std::array<char, 32> digits{};
  const auto [end, status] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), end};
}

}  // namespace palpation
