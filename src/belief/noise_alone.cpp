#include "belief/noise_alone.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "belief/tilts.h"

namespace palpation {
namespace {

constexpr double kNoiseFreeLog = 30.0;  // how far below the readings' own variance that of noise is
                                        // looked for: 1e-6 in standard deviation

/// What was felt at each site, about the mean of all: independent draws of one law.
struct Felt {
  Eigen::VectorXd count, mean;
  double all = 0.0, within = 0.0;  ///< how many, and their squares about the means of their sites

  explicit Felt(std::span<const Site> sites)
      : count(static_cast<Eigen::Index>(sites.size())), mean(count.size()) {
    const auto first = [](const Site& site) {
      return site.plain.empty() ? site.known.front() : site.plain.front();
    };
    const double origin = first(sites.front());
    for (Eigen::Index i = 0; i < count.size(); ++i) {
      const Site& site = sites[static_cast<std::size_t>(i)];
      std::vector<double> readings = site.plain;
      readings.insert(readings.end(), site.known.begin(), site.known.end());
      count[i] = static_cast<double>(readings.size());
      mean[i] = 0.0;
      for (double& reading : readings) mean[i] += (reading -= origin) / count[i];
      for (const double reading : readings) within += (reading - mean[i]) * (reading - mean[i]);
    }
    all = count.sum();
    mean.array() -= count.dot(mean) / all;
  }

  double squares() const { return within + count.dot(mean.cwiseAbs2()); }

  /// Around a constant that is unknown, by that variance, `square` what is left.
  double log_likelihood(double variance, double square) const {
    return -0.5 * ((all - 1.0) * std::log(2.0 * std::numbers::pi * variance) + std::log(all) +
                   square / variance);
  }
};

/// Around one unknown constant, their variance the best one.
NoiseAlone around_constant(const Felt& felt, const std::vector<double>& readings) {
  const double square = felt.squares();
  if (square <= 0.0) return {std::numeric_limits<double>::infinity(), readings};
  return {felt.log_likelihood(square / (felt.all - 1.0), square), readings};
}

/// Around an unknown constant and a slope of the prior's, the variance the best of a row of values
/// a tenth apart in logarithm.
NoiseAlone around_plane(const Prior& prior, std::span<const Site> sites, const Felt& felt,
                        const std::vector<double>& readings) {
  const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(
      readings.data(), static_cast<Eigen::Index>(readings.size()));
  Tilts tilts = tilts_of(prior, sites);
  tilts.rowwise() -= (felt.count.transpose() * tilts / felt.all).eval();
  const Tilts weighted = felt.count.asDiagonal() * tilts;
  const Eigen::Matrix3d gram = weighted.transpose() * tilts;
  const Vec3 along = weighted.transpose() * felt.mean;
  const double square = felt.squares();
  if (square <= 0.0) return around_constant(felt, readings);
  NoiseAlone best;
  const double most = std::log(square / felt.all);
  for (double log_variance = most; log_variance > most - kNoiseFreeLog; log_variance -= 0.1) {
    const double variance = std::exp(log_variance);
    const Eigen::LLT<Eigen::Matrix3d> precision(Eigen::Matrix3d::Identity() + gram / variance);
    const Vec3 tilt = precision.solve(along / variance);
    const double log_likelihood = felt.log_likelihood(variance, square - along.dot(tilt)) -
                                  precision.matrixLLT().diagonal().array().log().sum();
    if (!(log_likelihood > best.log_likelihood)) continue;
    const Eigen::VectorXd residuals = y - tilts * tilt;
    best = {log_likelihood, {residuals.begin(), residuals.end()}};
  }
  return best;
}

}  // namespace

NoiseAlone noise_alone(const Prior& prior, std::span<const Site> sites,
                       const std::vector<double>& readings) {
  const Felt felt(sites);
  return prior.has_slope() ? around_plane(prior, sites, felt, readings)
                           : around_constant(felt, readings);
}

}  // namespace palpation
