#include "readings/rounding.h"

#include <algorithm>
#include <vector>

#include "readings/readings.h"

namespace palpation {
namespace {

constexpr std::size_t kFewReadings = 10;
constexpr std::size_t kFewSteps = 3;

}  // namespace

double rounding_variance(std::span<const Palpation> palpations) {
  std::vector<double> values = used_readings(palpations);
  const std::size_t count = values.size();
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (count < kFewReadings || 2 * values.size() > count || values.size() < kFewSteps) return 0.0;
  double step = values.back() - values.front();
  for (std::size_t i = 1; i < values.size(); ++i) step = std::min(step, values[i] - values[i - 1]);
  return step * step / 12.0;
}

}  // namespace palpation
