#include "belief/noise_alone.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "belief/tilts.h"

namespace palpation {
namespace {

constexpr double kNoiseFreeLog = 30.0;  // how far below the readings' own variance that of noise is
                                        // looked for: 1e-6 in standard deviation

/// Around one unknown constant, their variance the best one.
NoiseAlone around_constant(const std::vector<double>& readings) {
  const double n = static_cast<double>(readings.size());
  double mean = 0.0, square = 0.0;
  for (double reading : readings) mean += reading / n;
  for (double reading : readings) square += (reading - mean) * (reading - mean);
  const double variance = square / (n - 1.0);
  if (variance <= 0.0) return {std::numeric_limits<double>::infinity(), readings};
  return {-0.5 * ((n - 1.0) * (std::log(2.0 * std::numbers::pi * variance) + 1.0) + std::log(n)),
          readings};
}

/// Around an unknown constant and a slope of the prior's, the variance the best of a row of values
/// a tenth apart in logarithm.
NoiseAlone around_plane(const Prior& prior, std::span<const Site> sites,
                        const std::vector<double>& readings) {
  const double n = static_cast<double>(readings.size());
  Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(readings.data(),
                                                        static_cast<Eigen::Index>(readings.size()));
  y.array() -= y.mean();
  Tilts tilts = tilts_of(prior, sites);
  tilts.rowwise() -= tilts.colwise().mean().eval();
  const Eigen::Matrix3d gram = tilts.transpose() * tilts;
  const Vec3 along = tilts.transpose() * y;
  const double square = y.squaredNorm();
  if (square <= 0.0) return around_constant(readings);
  NoiseAlone best;
  for (double log_variance = std::log(square / n);
       log_variance > std::log(square / n) - kNoiseFreeLog; log_variance -= 0.1) {
    const double variance = std::exp(log_variance);
    const Eigen::LLT<Eigen::Matrix3d> precision(Eigen::Matrix3d::Identity() + gram / variance);
    const Vec3 tilt = precision.solve(along / variance);
    const double log_likelihood =
        -0.5 * ((n - 1.0) * (std::log(2.0 * std::numbers::pi) + log_variance) + std::log(n) +
                (square - along.dot(tilt)) / variance) -
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
  return prior.has_slope() ? around_plane(prior, sites, readings) : around_constant(readings);
}

}  // namespace palpation
