// Whether there is an edge at all, or healthy tissue that waves slowly.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "certainty/edge_belief_fit.h"
#include "certainty/edge_data.h"

namespace palpation {
namespace {

/// Of waves: from the longer ones of the outlines' background on, to as long as tissue is wide.
constexpr std::array kLengths_m = {0.008, 0.012, 0.018, 0.027, 0.04};
/// How high they may be, of how the readings spread, and how large the noise, of what it was taken
/// for: standard deviations.
constexpr std::array kHeights = {0.0, 0.1, 0.3, 1.0, 3.0};
constexpr std::array kNoises = {0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0};

/// Normal readings, less what is expected of them.
struct Rows {
  const EdgeData& data;
  const Eigen::VectorXd& off;
  const Eigen::MatrixXd& covariance;  ///< without waves and noise
};

double log_density(const Rows& rows, const Eigen::MatrixXd& waves, double noise) {
  const EdgeData data = with_noise(noise * noise, rows.data);
  Eigen::MatrixXd covariance = rows.covariance + waves;
  covariance.diagonal() += data.variance;
  const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
  if (factor.info() != Eigen::Success) return -std::numeric_limits<double>::infinity();
  return data.log_scatter - 0.5 * rows.off.dot(factor.solve(rows.off)) -
         factor.matrixLLT().diagonal().array().log().sum();
}

}  // namespace

EdgeOdds EdgeBelief::odds_over_waves() const {
  const Fit& fit = most_likely();
  const Eigen::Index count = fit.data.reading.size();
  const Eigen::VectorXd off_edge = fit.edge.covariance.reconstructedMatrix() * fit.edge.pull;
  Eigen::MatrixXd edge = fit.edge.covariance.reconstructedMatrix();
  edge.diagonal() -= fit.edge.scatter * fit.data.variance;
  const double mean = fit.data.reading.mean();
  const Eigen::VectorXd off_mean = fit.data.reading.array() - mean;
  const double spread = std::sqrt(off_mean.squaredNorm() / static_cast<double>(count));
  const Eigen::MatrixXd constant = Eigen::MatrixXd::Constant(count, count, spread * spread);

  EdgeOdds odds;
  double with_edge = -std::numeric_limits<double>::infinity(), without = with_edge;
  for (const double length_m : kLengths_m) {
    const Prior waves(surface_, fit.correction.metric(),
                      Kernel{.family = KernelFamily::Matern52, .length_m = length_m},
                      Constant{.sd = 0.0});
    const Eigen::MatrixXd of_waves = waves.covariance(fit.data.places, fit.data.places);
    for (const double height : kHeights) {
      const Eigen::MatrixXd raised = std::pow(height * spread, 2) * of_waves;
      for (const double noise : kNoises) {
        with_edge = std::max(with_edge, log_density({fit.data, off_edge, edge}, raised, noise));
        const double waves_alone = log_density({fit.data, off_mean, constant}, raised, noise);
        if (waves_alone > without) {
          without = waves_alone;
          odds.wave_length_m = length_m;
        }
      }
    }
  }
  odds.log_odds = with_edge - freedom_ - without;
  return odds;
}

}  // namespace palpation
