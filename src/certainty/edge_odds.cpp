// Whether there is an edge at all, or healthy tissue that waves slowly, or both.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "certainty/edge_belief_fit.h"
#include "certainty/edge_data.h"
#include "certainty/wave_evidence.h"

namespace palpation {
namespace {

/// Of waves: from the longer ones of the outlines' background on, to as long as tissue is wide.
constexpr std::array kLengths_m = {0.008, 0.012, 0.018, 0.027, 0.04};
/// Texture, and slow waves.
constexpr std::array kUnevenLengths_m = {0.012, 0.0225, 0.04, 0.07};

double spread_of(const Eigen::VectorXd& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

/// Without an edge: one plateau, of which nothing is known.
Rows without_edge(const Rows& rows, const Eigen::VectorXd& readings) {
  const Eigen::Index count = readings.size();
  const double spread = spread_of(readings);
  return {rows.data, readings.array() - readings.mean(),
          Eigen::MatrixXd::Constant(count, count, spread * spread)};
}

SlowWaves waves_of(const Prior& correction, double length_m, const EdgeData& data) {
  return {correction.surface(), correction.metric(), length_m, data.places};
}

WavesFound likeliest(std::vector<WavesFound> found) {
  return *std::ranges::max_element(found, {}, &WavesFound::log_density);
}

}  // namespace

/// About the fit's edge and the readings as they were before waves were taken from them.
struct EdgeBelief::InWaves {
  Rows rows;
  Eigen::VectorXd readings;

  InWaves(const Surface& surface, const Fit& fit, const Field& taken_back)
      : readings(fit.data.reading) {
    Eigen::MatrixXd covariance = fit.edge.covariance.reconstructedMatrix();
    rows = {fit.data, covariance * fit.edge.pull, covariance};
    rows.covariance.diagonal() -= fit.edge.scatter * fit.data.variance;
    if (taken_back.size() == 0) return;
    for (Eigen::Index i = 0; i < readings.size(); ++i) {
      const double wave =
          surface.interpolate(taken_back, fit.data.places[static_cast<std::size_t>(i)]);
      rows.off[i] += wave;
      readings[i] += wave;
    }
  }
};

EdgeOdds EdgeBelief::odds_over_waves(const Field& taken_back) const {
  const Fit& fit = most_likely();
  const InWaves here(surface_, fit, taken_back);
  const double spread = spread_of(here.readings);
  const WithWaves edge(here.rows, spread), none(without_edge(here.rows, here.readings), spread);
  EdgeOdds odds;
  double with_edge = edge.level(), without = none.level();
  for (const double length_m : kLengths_m) {
    const SlowWaves waves = waves_of(fit.correction, length_m, fit.data);
    with_edge = std::max(with_edge, likeliest(edge.of(waves.terms())).log_density);
    const double waves_alone = likeliest(none.of(waves.terms())).log_density;
    if (waves_alone > without) {
      without = waves_alone;
      odds.wave_length_m = length_m;
    }
  }
  odds.log_odds = with_edge - freedom_ - without;
  return odds;
}

EdgeInWaves EdgeBelief::in_slow_waves(const Field& taken_back) const {
  const Fit& fit = most_likely();
  const InWaves here(surface_, fit, taken_back);
  const WithWaves edge(here.rows, spread_of(here.readings));
  EdgeInWaves found{.log_evidence_level = edge.level() - freedom_};
  std::vector<double> densities;
  WavesFound most;
  double best = edge.level();
  for (const double one_m : kUnevenLengths_m) {
    const bool is_slow = one_m >= kSlowLengths_m.front();
    for (WavesFound& one : edge.of(waves_of(fit.correction, one_m, fit.data).terms())) {
      densities.push_back(one.log_density);
      best = std::max(best, one.log_density);
      if (!is_slow || !(one.log_density > most.log_density)) continue;
      found.scale = {one_m, one.height};
      most = std::move(one);
    }
  }
  if (most.coefficients.size() == 0) {  // no noise makes the covariance positive definite
    found.log_evidence = found.log_evidence_level;
    found.waves = Field::Zero(surface_.vertex_count());
    return found;
  }
  double mean = 0.0;
  for (const double one : densities)
    mean += std::exp(one - best) / static_cast<double>(densities.size());
  found.log_evidence = best + std::log(mean) - freedom_;
  found.waves = waves_of(fit.correction, found.scale.length_m, fit.data)
                    .at_vertices(most.height * most.coefficients);
  return found;
}

}  // namespace palpation
