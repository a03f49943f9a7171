#include "certainty/wave_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace palpation {
namespace {

/// How high waves may be and how large a reading's noise, of how the readings spread: standard
/// deviations. The same for all explanations of the same readings, whatever noise each was found
/// by.
constexpr std::array kHeights = {0.1, 0.3, 1.0, 3.0};
constexpr std::array kNoises = {0.005, 0.007, 0.01, 0.014, 0.02, 0.028, 0.04, 0.056,
                                0.08,  0.11,  0.16, 0.22,  0.32, 0.45,  0.64, 0.9};

/// Noises that are looked at first, of all; then those beside the likeliest.
constexpr std::size_t kOneIn = 3;

/// From a noise on, as long as one beside it is likelier.
template <class LogDensity>
std::size_t climbed(std::size_t noise, const LogDensity& log_density) {
  for (;;) {
    std::size_t best = noise;
    for (const std::size_t beside : {noise > 0 ? noise - 1 : noise, noise + 1}) {
      if (beside < kNoises.size() && log_density(beside) > log_density(best)) best = beside;
    }
    if (best == noise) return noise;
    noise = best;
  }
}

}  // namespace

WithWaves::WithWaves(Rows rows, double spread)
    : rows_(std::move(rows)), spread_(spread), by_noise_(kNoises.size()) {
  const auto log_density = [&](std::size_t noise) {
    const std::optional<ByNoise>& by = by_noise(noise);
    return by ? by->log_density : -std::numeric_limits<double>::infinity();
  };
  for (std::size_t noise = 0; noise < kNoises.size(); noise += kOneIn) {
    if (log_density(noise) > log_density(likeliest_)) likeliest_ = noise;
  }
  likeliest_ = climbed(likeliest_, log_density);
  level_ = log_density(likeliest_);
}

const std::optional<WithWaves::ByNoise>& WithWaves::by_noise(std::size_t noise) const {
  std::optional<std::optional<ByNoise>>& known = by_noise_[noise];
  if (known) return *known;
  known.emplace();
  const EdgeData data = with_noise(
      std::pow(kNoises[noise] * spread_, 2) / rows_.data.variance.maxCoeff(), rows_.data);
  Eigen::MatrixXd covariance = rows_.covariance;
  covariance.diagonal() += data.variance;
  TiledLlt factor(covariance);
  if (factor.info() != Eigen::Success) return *known;
  const Eigen::VectorXd off = factor.matrixL().solve(rows_.off);
  const double log_density = data.log_scatter - 0.5 * off.squaredNorm() -
                             factor.matrixLLT().diagonal().array().log().sum();
  *known = ByNoise{std::move(factor), off, log_density};
  return *known;
}

Eigen::VectorXd WithWaves::pull() const {
  const std::optional<ByNoise>& by = by_noise(likeliest_);
  return by ? Eigen::VectorXd(by->factor.matrixU().solve(by->off))
            : Eigen::VectorXd::Zero(rows_.off.size());
}

std::vector<WavesFound> WithWaves::of(const Eigen::MatrixXd& terms) const {
  using OfHeights = std::array<WavesFound, kHeights.size()>;
  std::array<std::optional<OfHeights>, kNoises.size()> known;
  const auto at = [&](std::size_t noise) -> const OfHeights& {
    std::optional<OfHeights>& of_heights = known[noise];
    if (of_heights) return *of_heights;
    of_heights.emplace();
    const std::optional<ByNoise>& by = by_noise(noise);
    if (!by) return *of_heights;
    const Eigen::MatrixXd seen = by->factor.matrixL().solve(terms);
    const Eigen::MatrixXd information = seen.transpose() * seen;
    const Eigen::VectorXd pull = seen.transpose() * by->off;
    for (std::size_t i = 0; i < kHeights.size(); ++i) {
      const double height = kHeights[i] * spread_, square = height * height;
      Eigen::MatrixXd precision = square * information;
      precision.diagonal().array() += 1.0;
      const Eigen::LLT<Eigen::MatrixXd> of_terms(precision);
      const Eigen::VectorXd mean = square * of_terms.solve(pull);
      const double density = by->log_density + 0.5 * pull.dot(mean) -
                             of_terms.matrixLLT().diagonal().array().log().sum();
      (*of_heights)[i] = {density, height, mean};
    }
    return *of_heights;
  };
  std::vector<WavesFound> found;
  for (std::size_t i = 0; i < kHeights.size(); ++i) {
    const std::size_t noise =
        climbed(likeliest_, [&](std::size_t one) { return at(one)[i].log_density; });
    found.push_back(at(noise)[i]);
  }
  return found;
}

}  // namespace palpation
