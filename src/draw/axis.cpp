#include "draw/axis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace palpation::draw {
namespace {

std::string with_true_minus(std::string number) {
  if (!number.empty() && number.front() == '-') number.replace(0, 1, "\u2212");
  return number;
}

// The smallest of 1, 2, 5 times a power of ten that is at least the given step.
double round_step(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= step * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

std::string fixed_number(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return with_true_minus(text);
}

}  // namespace

std::vector<Tick> ticks(double lowest, double highest, int wanted) {
  if (!(highest > lowest) || !std::isfinite(highest - lowest)) return {};
  const double step = round_step((highest - lowest) / std::max(wanted, 1));
  const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 12);
  const double slack = step * 1e-9;
  std::vector<Tick> result;
  for (double count = std::ceil((lowest - slack) / step); count * step <= highest + slack;
       ++count) {
    const double value = count == 0.0 ? 0.0 : count * step;
    const bool plain = std::abs(value) < 1e6 && decimals <= 6;
    result.push_back({value, plain ? fixed_number(value, decimals) : short_number(value, 3)});
  }
  return result;
}

std::vector<Tick> logarithmic_ticks(double lowest, double highest) {
  if (!(lowest > 0.0) || !(highest > lowest) || !std::isfinite(highest)) return {};
  const bool narrow = std::log10(highest / lowest) < 2.0;
  std::vector<Tick> result;
  for (double decade = std::floor(std::log10(lowest)); decade <= std::ceil(std::log10(highest));
       ++decade) {
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * std::pow(10.0, decade);
      if (value < lowest * (1.0 - 1e-9) || value > highest * (1.0 + 1e-9)) continue;
      const bool labelled = digit == 1 || (narrow && (digit == 2 || digit == 5));
      result.push_back({value, labelled ? short_number(value, 3) : ""});
    }
  }
  return result;
}

std::string short_number(double value, int significant_digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", significant_digits, value);
  const std::string number = text;
  const bool huge_but_plain =
      number.find('e') != std::string::npos && std::abs(value) >= 1.0 && std::abs(value) < 1e7;
  return huge_but_plain ? fixed_number(value, 0) : with_true_minus(number);
}

}  // namespace palpation::draw
