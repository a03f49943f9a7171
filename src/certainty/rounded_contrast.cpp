#include "certainty/rounded_contrast.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "base/normal.h"
#include "readings/rounding.h"

namespace palpation {
namespace {

constexpr double kLeastProbability = 1e-300;
/// The likeliest normal law is found by steps of its standard deviation, which are halved so often.
constexpr int kHalvings = 12;

/// How often each value, in steps from the least, was read.
using Counts = std::map<double, double>;

double log_likelihood(const Counts& counts, double mean, double sd) {
  double sum = 0.0;
  for (const auto& [value, times] : counts) {
    const double from = (value - 0.5 - mean) / sd, to = (value + 0.5 - mean) / sd;
    // Of the upper tail by the lower one, which rounding leaves.
    const double probability = from > 0.0 ? normal_probability(-from) - normal_probability(-to)
                                          : normal_probability(to) - normal_probability(from);
    sum += times * std::log(std::max(probability, kLeastProbability));
  }
  return sum;
}

/// By the likeliest mean and standard deviation, uphill from those of the values themselves.
double log_likelihood_of_noise(const Counts& counts, double mean, double sd) {
  double log_sd = std::log(sd), best = log_likelihood(counts, mean, sd);
  for (double step = 1.0; step > std::ldexp(1.0, -kHalvings);) {
    bool is_better = false;
    for (const auto& [by_mean, by_log_sd] : {std::pair(step, 0.0), std::pair(-step, 0.0),
                                             std::pair(0.0, step), std::pair(0.0, -step)}) {
      const double here =
          log_likelihood(counts, mean + by_mean * std::exp(log_sd), std::exp(log_sd + by_log_sd));
      if (!(here > best)) continue;
      best = here;
      mean += by_mean * std::exp(log_sd);
      log_sd += by_log_sd;
      is_better = true;
    }
    if (!is_better) step *= 0.5;
  }
  return best;
}

}  // namespace

double most_evidence_if_rounded(std::span<const double> readings) {
  const std::optional<double> step = step_of(readings);
  if (!step) return std::numeric_limits<double>::infinity();
  const double least = *std::ranges::min_element(readings),
               count = static_cast<double>(readings.size());
  Counts counts;
  for (const double reading : readings) counts[std::round((reading - least) / *step)] += 1.0;
  double mean = 0.0, square = 0.0, of_any_law = 0.0;
  for (const auto& [steps, times] : counts) {
    mean += times * steps / count;
    of_any_law += times * std::log(times / count);
  }
  for (const auto& [steps, times] : counts) square += times * (steps - mean) * (steps - mean);
  return of_any_law - log_likelihood_of_noise(counts, mean, std::sqrt(square / count));
}

}  // namespace palpation
