#include "readings/saturation.h"

#include <algorithm>
#include <vector>

namespace palpation {
namespace {

constexpr std::size_t kFewest = 3;

}  // namespace

std::optional<Saturation> saturation_of(std::span<const double> readings) {
  std::vector<double> rising(readings.begin(), readings.end());
  std::ranges::sort(rising);
  std::vector<Saturation> values;  // in turn, each with how often it occurs
  for (const double reading : rising) {
    if (values.empty() || values.back().value != reading)
      values.push_back({.value = reading, .count = 0});
    ++values.back().count;
  }
  if (values.size() < 2) return std::nullopt;
  std::size_t shared = 0;
  for (std::size_t i = 1; i + 1 < values.size(); ++i) shared = std::max(shared, values[i].count);
  const auto is_end = [&](const Saturation& end) {
    return end.count >= kFewest && end.count > 2 * shared && 2 * end.count < rising.size();
  };
  Saturation &least = values.front(), &greatest = values.back();
  least.is_upper = false;
  greatest.is_alone = !is_end(least);
  if (is_end(greatest)) return greatest;
  return is_end(least) ? std::optional(least) : std::nullopt;
}

}  // namespace palpation
