#include "tool/option_checks.h"

#include <charconv>

#include "palpation/base/error.h"

namespace palpation::tool {
namespace {

CLI::Validator number_among(const std::string& characters, const std::string& kind, double least,
                            double most) {
  const std::string range = text_of(least) + " to " + text_of(most);
  const auto fault = [=](std::string& text) {
    double value = 0.0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_one = status == std::errc{} && end == text.data() + text.size() &&
                        text.find_first_not_of(characters) == std::string::npos;
    return is_one && value >= least && value <= most
               ? std::string()
               : "is " + text + ", but must be a " + kind + " from " + range;
  };
  return CLI::Validator(fault, range);
}

}  // namespace

CLI::Validator number(double least, double most) {
  return number_among("0123456789+-.eE", "number", least, most);
}
CLI::Validator whole(double least, double most) {
  return number_among("0123456789", "whole number", least, most);
}

}  // namespace palpation::tool
