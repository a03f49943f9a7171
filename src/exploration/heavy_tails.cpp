#include "exploration/heavy_tails.h"

#include <cmath>

#include "exploration/field_fit.h"
#include "readings/readings.h"

namespace palpation {
namespace {

/// Four degrees of freedom: one reading in fifty lies beyond three and a half scales, where a
/// normal has one in two thousand.
constexpr double kFreedom = 4.0;

constexpr int kRounds = 100;

bool is_weighed(const Palpation& palpation) {
  return palpation.set_aside.empty() && std::isnan(palpation.noise_variance);
}

double weight_of(double square, double noise_sd) {
  return (kFreedom + 1.0) / (kFreedom + square / (noise_sd * noise_sd));
}

}  // namespace

std::vector<Palpation> drawn_in(std::vector<Palpation> palpations) {
  const std::vector<double> readings = used_readings(palpations);
  if (readings.empty()) return palpations;
  auto [middle, scale] = spread_of(readings);
  for (int round = 0; round < kRounds && scale > 0.0; ++round) {
    double weights = 0.0, sum = 0.0, squares = 0.0;
    for (const double reading : readings) {
      const double from = reading - middle, weight = weight_of(from * from, scale);
      weights += weight;
      sum += weight * from;
      squares += weight * from * from;
    }
    middle += sum / weights;
    scale = std::sqrt(squares / static_cast<double>(readings.size()));
  }
  if (scale > 0.0) {
    for (Palpation& palpation : palpations) {
      const double from = palpation.reading - middle;
      palpation.reading = middle + std::sqrt(weight_of(from * from, scale)) * from;
    }
  }
  return palpations;
}

WeighedReadings weighed_for_heavy_tails(const Belief& belief, std::span<const Palpation> palpations,
                                        double noise_sd) {
  WeighedReadings result{{palpations.begin(), palpations.end()}, noise_sd};
  if (!(noise_sd > 0.0)) return result;
  std::vector<SurfacePoint> places;
  for (const Palpation& palpation : palpations) places.push_back(palpation.where);
  const Marginals field = belief.at(places);
  double sum = 0.0, count = 0.0;
  std::vector<double> weights(palpations.size(), 1.0);
  for (std::size_t i = 0; i < palpations.size(); ++i) {
    if (!is_weighed(palpations[i])) continue;
    const auto at = static_cast<Eigen::Index>(i);
    const double residual = palpations[i].reading - field.mean[at];
    const double square = residual * residual + field.variance[at];
    weights[i] = weight_of(square, noise_sd);
    sum += weights[i] * square;
    count += 1.0;
  }
  if (count > 0.0 && sum > 0.0) result.noise_sd = std::sqrt(sum / count);
  for (std::size_t i = 0; i < palpations.size(); ++i) {
    if (is_weighed(palpations[i]))
      result.palpations[i].noise_variance = result.noise_sd * result.noise_sd / weights[i];
  }
  return result;
}

}  // namespace palpation
