#include "certainty/wave_evidence.h"

#include <algorithm>
#include <array>

namespace palpation {
namespace {

/// How high waves may be and how large a reading's noise, of how the readings spread: standard
/// deviations. The same for all explanations of the same readings, whatever noise each was found
/// by.
constexpr std::array kHeights = {0.1, 0.3, 1.0, 3.0};
constexpr std::array kNoises = {0.005, 0.007, 0.01, 0.014, 0.02, 0.028, 0.04, 0.056,
                                0.08,  0.11,  0.16, 0.22,  0.32, 0.45,  0.64, 0.9};

}  // namespace

WithWaves::WithWaves(const Rows& rows, double spread) : spread_(spread) {
  const double one_reading = rows.data.variance.maxCoeff();
  for (const double noise : kNoises) {
    const EdgeData data = with_noise(noise * noise * spread * spread / one_reading, rows.data);
    Eigen::MatrixXd covariance = rows.covariance;
    covariance.diagonal() += data.variance;
    TiledLlt factor(covariance);
    if (factor.info() != Eigen::Success) continue;
    const Eigen::VectorXd off = factor.matrixL().solve(rows.off);
    const double log_density = data.log_scatter - 0.5 * off.squaredNorm() -
                               factor.matrixLLT().diagonal().array().log().sum();
    by_noise_.push_back({std::move(factor), off, log_density});
    level_ = std::max(level_, log_density);
  }
}

std::vector<WavesFound> WithWaves::of(const Eigen::MatrixXd& terms) const {
  std::vector<WavesFound> found(kHeights.size());
  for (const auto& [factor, off, log_density] : by_noise_) {
    const Eigen::MatrixXd seen = factor.matrixL().solve(terms);
    const Eigen::MatrixXd information = seen.transpose() * seen;
    const Eigen::VectorXd pull = seen.transpose() * off;
    for (std::size_t i = 0; i < kHeights.size(); ++i) {
      const double height = kHeights[i] * spread_, square = height * height;
      Eigen::MatrixXd precision = square * information;
      precision.diagonal().array() += 1.0;
      const Eigen::LLT<Eigen::MatrixXd> of_terms(precision);
      const Eigen::VectorXd mean = square * of_terms.solve(pull);
      const double density =
          log_density + 0.5 * pull.dot(mean) - of_terms.matrixLLT().diagonal().array().log().sum();
      if (density > found[i].log_density) found[i] = {density, height, mean};
    }
  }
  return found;
}

}  // namespace palpation
