#include "palpation/base/error.h"

#include <array>
#include <charconv>
#include <utility>

#include "palpation/base/contract.h"

namespace palpation {

void require(bool condition, const std::string& function, const std::string& value,
             const std::string& rule) {
  if (!condition) throw BrokenContract(function, value, rule);
}

BrokenContract::BrokenContract(std::string function, std::string value, std::string rule)
    : InvalidInput(function + ": " + value + " " + rule),
      function_(std::move(function)),
      value_(std::move(value)),
      rule_(std::move(rule)) {}

std::string rule_words(const InvalidInput& error) {
  const auto* const broken = dynamic_cast<const BrokenContract*>(&error);
  return broken != nullptr ? broken->value() + " " + broken->rule() : error.what();
}

std::string text_of(double value) {
  std::array<char, 32> digits{};
  const auto [end, status] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), end};
}

}  // namespace palpation
