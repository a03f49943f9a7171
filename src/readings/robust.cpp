#include "readings/robust.h"

#include <algorithm>
#include <cmath>

namespace palpation {

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  const double position = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], position - static_cast<double>(below));
}

double median(const std::vector<double>& values) { return quantile(values, 0.5); }

double robust_sd(const std::vector<double>& values) {
  const double middle = median(values);
  std::vector<double> deviations;
  for (double value : values) deviations.push_back(std::abs(value - middle));
  return 1.4826 * median(deviations);
}

}  // namespace palpation
