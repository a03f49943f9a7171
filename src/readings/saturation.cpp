#include "readings/saturation.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "readings/readings.h"

namespace palpation {
namespace {

constexpr std::size_t kFewest = 3;
constexpr double kFarthest = 2.0;  ///< from the others, over what they span

struct Value {
  double value = 0.0;
  std::size_t count = 0;
};

/// In turn, each with how often it occurs.
std::vector<Value> values_of(std::span<const double> readings) {
  std::vector<double> rising(readings.begin(), readings.end());
  std::ranges::sort(rising);
  std::vector<Value> values;
  for (const double reading : rising) {
    if (values.empty() || values.back().value != reading) values.push_back({reading, 0});
    ++values.back().count;
  }
  return values;
}

}  // namespace

std::optional<Saturation> saturation_of(std::span<const double> readings) {
  const std::vector<Value> values = values_of(readings);
  if (values.size() < 3) return std::nullopt;
  std::size_t shared = 0;
  for (std::size_t i = 1; i + 1 < values.size(); ++i) shared = std::max(shared, values[i].count);
  const auto is_end = [&](const Value& end, const Value& next, const Value& other) {
    return end.count >= kFewest && end.count > 2 * shared &&
           std::abs(end.value - next.value) <= kFarthest * std::abs(next.value - other.value);
  };
  const Value &least = values.front(), &greatest = values.back();
  const bool both = least.count >= kFewest && greatest.count >= kFewest;
  const auto saturation = [&](const Value& end, bool is_upper) {
    return Saturation{.value = end.value,
                      .count = end.count,
                      .is_upper = is_upper,
                      .may_be_tissue = both || 2 * end.count >= readings.size()};
  };
  if (is_end(greatest, values[values.size() - 2], least)) return saturation(greatest, true);
  if (is_end(least, values[1], greatest)) return saturation(least, false);
  return std::nullopt;
}

std::vector<Saturation> saturations_of(std::span<const Palpation> palpations) {
  std::vector<Saturation> found;
  if (const auto of_all = saturation_of(used_readings(palpations))) found.push_back(*of_all);
  std::map<int, std::vector<double>> sessions;
  for (const Palpation& one : palpations) {
    if (counts(one)) sessions[one.session].push_back(one.reading);
  }
  if (sessions.size() < 2) return found;
  const bool is_known = !found.empty() && !found.front().may_be_tissue;
  for (const auto& [session, readings] : sessions) {
    std::optional<Saturation> own = saturation_of(readings);
    if (!own || (is_known && own->value == found.front().value)) continue;
    own->session = session;
    found.push_back(*own);
  }
  return found;
}

}  // namespace palpation
