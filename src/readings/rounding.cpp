#include "readings/rounding.h"

#include <algorithm>
#include <vector>

#include "readings/readings.h"

namespace palpation {
namespace {

constexpr std::size_t kFewReadings = 10;
constexpr std::size_t kFewSteps = 3;

std::vector<double> values_of(std::span<const double> readings) {
  std::vector<double> values(readings.begin(), readings.end());
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}  // namespace

std::optional<double> step_of(std::span<const double> readings) {
  const std::vector<double> values = values_of(readings);
  if (readings.size() < kFewReadings || 2 * values.size() > readings.size() || values.size() < 2)
    return std::nullopt;
  double step = values.back() - values.front();
  for (std::size_t i = 1; i < values.size(); ++i) step = std::min(step, values[i] - values[i - 1]);
  return step;
}

double rounding_variance(std::span<const Palpation> palpations) {
  const std::vector<double> readings = used_readings(palpations);
  const std::optional<double> step = step_of(readings);
  if (!step || values_of(readings).size() < kFewSteps) return 0.0;
  return *step * *step / 12.0;
}

}  // namespace palpation
