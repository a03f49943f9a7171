#include "results/limits.h"

#include <algorithm>
#include <cmath>

#include "results/pack.h"

namespace palpation::results {
namespace {

constexpr double kNoiseShown = 3.0;
constexpr double kLeast = 1e-12;

}  // namespace

Limits limits_of_mean(const std::vector<double>& mean, std::optional<double> level,
                      double noise_sd) {
  const double low = quantile(mean, kBeyondShare), high = quantile(mean, 1.0 - kBeyondShare);
  const double middle = level.value_or(0.5 * (low + high));
  const double least = level ? 0.0 : kNoiseShown * noise_sd;
  const double half = std::max(
      {high - middle, middle - low, least, kLeast * std::max(1.0, std::abs(middle)), kLeast});
  return {middle - half, middle + half};
}

Limits limits_from_zero(const std::vector<double>& values) {
  const double low = quantile(values, 0.0);
  return {std::min(0.0, low), std::max(quantile(values, 1.0 - kBeyondShare), kLeast)};
}

}  // namespace palpation::results
