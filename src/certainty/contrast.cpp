#include "certainty/contrast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "certainty/rounded_contrast.h"

namespace palpation {
namespace {

constexpr double kEnoughSignal = 5.0;
constexpr double kEnoughContrast = 5.0;
constexpr std::size_t kFewReadings = 10;
constexpr std::size_t kManyReadings = 30;
constexpr std::size_t kFewOf = 20;
constexpr int kRounds = 60;
constexpr std::array kHighShares = {0.01, 0.05, 0.1, 0.2, 0.35};
/// Noise below this part of the readings' variance is no noise: the ratio would grow without bound.
constexpr double kLeastVariance = 1e-3;

struct Plateaus {
  double share;  // of the readings that lie on the high one
  double low, high, variance;
};

/// Improves the plateaus by one round; returns the log likelihood before it, up to a constant.
double improve(std::span<const double> readings, Plateaus& plateaus, double least_variance) {
  const auto count = static_cast<double>(readings.size());
  double log_likelihood = 0.0, high_weight = 0.0, high_sum = 0.0, low_sum = 0.0;
  std::vector<double> on_high;
  for (const double reading : readings) {
    const double from_high = reading - plateaus.high, from_low = reading - plateaus.low;
    const double high = std::log(plateaus.share) - 0.5 * from_high * from_high / plateaus.variance;
    const double low = std::log1p(-plateaus.share) - 0.5 * from_low * from_low / plateaus.variance;
    const double greater = std::max(high, low);
    const double both = greater + std::log(std::exp(high - greater) + std::exp(low - greater));
    log_likelihood += both - 0.5 * std::log(plateaus.variance);
    on_high.push_back(std::exp(high - both));
    high_weight += on_high.back();
    high_sum += on_high.back() * reading;
    low_sum += (1.0 - on_high.back()) * reading;
  }
  if (high_weight > 0.0) plateaus.high = high_sum / high_weight;
  if (high_weight < count) plateaus.low = low_sum / (count - high_weight);
  double square = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const double from_high = readings[i] - plateaus.high, from_low = readings[i] - plateaus.low;
    square += on_high[i] * from_high * from_high + (1.0 - on_high[i]) * from_low * from_low;
  }
  plateaus.share = std::clamp(high_weight / count, 1.0 / count, 0.5);
  plateaus.variance = std::max(square / count, least_variance);
  return log_likelihood;
}

double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value - values.front();
  return values.front() + sum / static_cast<double>(values.size());
}

}  // namespace

std::optional<TwoPlateaus> two_plateaus(std::span<const double> readings) {
  if (readings.size() < kFewReadings) return std::nullopt;
  const auto count = static_cast<double>(readings.size());
  const double mean = mean_of(readings);
  double variance = 0.0;
  for (const double reading : readings) variance += (reading - mean) * (reading - mean) / count;
  if (!(variance > 0.0)) return std::nullopt;

  std::vector<double> sorted(readings.begin(), readings.end());
  std::sort(sorted.begin(), sorted.end());
  TwoPlateaus best{mean, mean, 0.0};
  for (const double share : kHighShares) {
    const auto high = static_cast<std::size_t>(std::max(1.0, std::round(share * count)));
    const std::span all(sorted);
    const double low_mean = mean_of(all.first(sorted.size() - high)),
                 high_mean = mean_of(all.last(high));
    double square = 0.0;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      const double from = sorted[i] - (i + high < sorted.size() ? low_mean : high_mean);
      square += from * from;
    }
    const double least = kLeastVariance * variance;
    Plateaus plateaus{static_cast<double>(high) / count, low_mean, high_mean,
                      std::max(square / count, least)};
    for (int round = 0; round < kRounds; ++round) {
      const double evidence =
          improve(sorted, plateaus, least) + 0.5 * count * (1.0 + std::log(variance));
      if (plateaus.high > plateaus.low && evidence > best.evidence)
        best = {plateaus.low, plateaus.high, evidence};
    }
  }
  return best;
}

double evidence_of_two_plateaus_in_turn(std::span<const double> readings, std::size_t apart) {
  double sum = 0.0;
  for (std::size_t first = 0; first < apart; ++first) {
    std::vector<double> kept;
    for (std::size_t i = first; i < readings.size(); i += apart) kept.push_back(readings[i]);
    if (const std::optional<TwoPlateaus> plateaus = two_plateaus(kept)) sum += plateaus->evidence;
  }
  return sum / static_cast<double>(apart);
}

std::size_t few_of(std::size_t readings) { return std::max<std::size_t>(readings / kFewOf, 1); }

std::optional<ReadingsApart> readings_apart(std::span<const double> readings, std::size_t most) {
  const std::size_t count = readings.size();
  if (count < kManyReadings) return std::nullopt;
  std::vector<std::size_t> rising(count);
  std::iota(rising.begin(), rising.end(), std::size_t{0});
  std::ranges::stable_sort(rising, {}, [&](std::size_t i) { return readings[i]; });
  const auto at = [&](std::size_t rank) { return readings[rising[rank]]; };

  // The others are neighbours in value: those from `first` to `last`.
  for (std::size_t few = std::min(most, count - 2); few > 0; --few) {
    std::optional<ReadingsApart> best;
    for (std::size_t first = 0; first <= few; ++first) {
      const std::size_t last = first + count - few - 1;
      const double span = at(last) - at(first);
      double gap = std::numeric_limits<double>::infinity();
      if (first > 0) gap = std::min(gap, at(first) - at(first - 1));
      if (last + 1 < count) gap = std::min(gap, at(last + 1) - at(last));
      if (!(gap > span) || (best && !(gap / span > best->spans))) continue;
      best = ReadingsApart{{rising.begin(), rising.begin() + first}, gap / span};
      best->numbers.insert(best->numbers.end(), rising.begin() + last + 1, rising.end());
    }
    if (!best) continue;
    std::ranges::sort(best->numbers);
    return best;
  }
  return std::nullopt;
}

bool shows_field(double signal_evidence) { return signal_evidence > kEnoughSignal; }

bool shows_contrast(std::span<const double> readings, double signal_evidence) {
  if (shows_field(signal_evidence)) return true;
  const std::optional<TwoPlateaus> plateaus = two_plateaus(readings);
  return plateaus &&
         std::min(plateaus->evidence, most_evidence_if_rounded(readings)) > kEnoughContrast;
}

}  // namespace palpation
