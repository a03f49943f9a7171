#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "belief/correlations.h"
#include "belief/tilts.h"
#include "palpation/base/error.h"
#include "palpation/base/positive_definite.h"
#include "palpation/belief/hyperparameters.h"

namespace palpation {
namespace {

/// d log(scatter likelihood) / d log(noise sd), and d (merged variance, merged mean) / d log(noise sd).
struct NoiseSlopes {
  double scatter = 0.0;
  double variance = 0.0;
  double mean = 0.0;
};

NoiseSlopes noise_slopes(const Site& site, const MergedReading& merged, double noise_variance) {
  const double count = static_cast<double>(site.plain.size());
  if (site.plain.empty() || noise_variance == 0.0 || merged.variance == 0.0) return {};
  double plain_mean = 0.0, plain_square = 0.0;
  for (double reading : site.plain) {
    plain_mean += reading / count;
    plain_square += (reading - merged.mean) * (reading - merged.mean);
  }
  const double share = count * merged.variance / noise_variance;  // of the precision
  return {plain_square / noise_variance - count + share, 2.0 * merged.variance * share, 2.0 * share * (merged.mean - plain_mean)};
}

/// P of likelihood_gradient once a slope of normal prior is integrated out too, P - P H (I + H' P H)^-1 H' P with H = Prior::tilt at the
/// sites; returns what that adds to the log likelihood besides the change of P.
double integrate_slope_out(const Prior& prior, std::span<const Site> sites, Eigen::MatrixXd& p) {
  const Tilts tilts = tilts_of(prior, sites);
  const Tilts weights = p * tilts;
  const Eigen::LLT<Eigen::Matrix3d> precision(Eigen::Matrix3d::Identity() + tilts.transpose() * weights);
  p.noalias() -= weights * precision.solve(weights.transpose());
  return -precision.matrixLLT().diagonal().array().log().sum();
}

}  // namespace

LikelihoodGradient likelihood_gradient(const Prior& prior, std::span<const Site> sites, const Hyperparameters& at) {
  const auto n = static_cast<Eigen::Index>(sites.size());
  Kernel kernel = prior.kernel();
  kernel.length_m = at.length_m;
  const double signal_variance = at.signal_sd * at.signal_sd;
  const double noise_variance = at.noise_sd * at.noise_sd;

  const auto [k, k_slope] = correlation_slopes(prior, kernel, sites);
  Eigen::VectorXd readings(n), variances(n), variance_slopes(n), mean_slopes(n);
  LikelihoodGradient result;
  for (Eigen::Index i = 0; i < n; ++i) {
    const MergedReading merged = merge(sites[i], noise_variance);
    const NoiseSlopes slopes = noise_slopes(sites[i], merged, noise_variance);
    readings[i] = merged.mean;
    variances[i] = merged.variance;
    variance_slopes[i] = slopes.variance;
    mean_slopes[i] = slopes.mean;
    result.value += scatter_log_likelihood(sites[i], noise_variance);
    result.gradient[2] += slopes.scatter;
  }

  // S = signal^2 K + D;  P = S^-1 - S^-1 1 1' S^-1 / (1' S^-1 1 + 1 / constant_sd^2).
  Eigen::MatrixXd s = signal_variance * k;
  s.diagonal() += variances;
  Eigen::MatrixXd p = std::move(s);
  const std::optional<double> log_determinant = invert_positive_definite(p);
  if (!log_determinant)
    throw NumericalError("likelihood_gradient: the covariance is not positive definite at length " + text_of(at.length_m));
  result.value -= 0.5 * *log_determinant;
  double free_readings = static_cast<double>(n);
  const double constant_sd = prior.constant().sd;
  if (constant_sd > 0.0) {
    const double constant_precision = 1.0 / (constant_sd * constant_sd);  // 0 if infinite
    const Eigen::VectorXd weights = p.rowwise().sum();
    const double precision = weights.sum() + constant_precision;
    p.noalias() -= weights * weights.transpose() / precision;
    if (std::isinf(constant_sd)) {
      result.value -= 0.5 * std::log(precision);
      free_readings -= 1.0;
    } else {
      result.value -= 0.5 * std::log(precision / constant_precision);
    }
  }
  if (prior.has_slope()) result.value += integrate_slope_out(prior, sites, p);
  // Readings are taken relative to one of them where the constant is unknown: P 1 = 0 then, so only rounding changes.
  const double origin = std::isinf(constant_sd) ? readings[0] : 0.0;
  const Eigen::VectorXd residuals = readings.array() - origin;
  const Eigen::VectorXd a = p * residuals;
  result.value -= 0.5 * (residuals.dot(a) + free_readings * std::log(2.0 * std::numbers::pi));

  const auto slope = [&](const auto& s_slope) { return 0.5 * (a.dot(s_slope * a) - p.cwiseProduct(s_slope).sum()); };
  result.gradient[0] = signal_variance * slope(k_slope);
  result.gradient[1] = 2.0 * signal_variance * slope(k);
  result.gradient[2] += 0.5 * (a.array().square() * variance_slopes.array() - p.diagonal().array() * variance_slopes.array()).sum();
  result.gradient[2] -= a.dot(mean_slopes);
  return result;
}

/// With L L' = S, w = L^-1 (y - origin) and H = L^-1 (the constant and the slope, each over its prior's standard deviation):
/// log p = -(w'w - w'H (I + H'H)^-1 H'w + log|S| + log|I + H'H| + n log 2 pi) / 2, without I for a constant that is not known at all.
double log_likelihood(const Prior& prior, std::span<const Site> sites, const Hyperparameters& at) {
  const auto n = static_cast<Eigen::Index>(sites.size());
  Kernel kernel = prior.kernel();
  kernel.length_m = at.length_m;
  const double noise_variance = at.noise_sd * at.noise_sd;
  const double constant_sd = prior.constant().sd;
  double result = 0.0;
  Eigen::MatrixXd s = at.signal_sd * at.signal_sd * correlations(prior, kernel, sites);
  Eigen::MatrixXd right(n, 5);  // readings, constant, slope
  right.rightCols<3>() = tilts_of(prior, sites);
  for (Eigen::Index j = 0; j < n; ++j) {
    const MergedReading merged = merge(sites[j], noise_variance);
    result += scatter_log_likelihood(sites[j], noise_variance);
    s(j, j) += merged.variance;
    right(j, 0) = merged.mean;
    right(j, 1) = std::isinf(constant_sd) ? 1.0 : constant_sd;
  }
  // Readings are taken relative to one of them where the constant is not known: rounding is all that changes.
  if (std::isinf(constant_sd)) right.col(0).array() -= right(0, 0);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(s);
  const auto diagonal = s.diagonal().array();
  if (factor.info() != Eigen::Success || !diagonal.isFinite().all() || !(diagonal > 0.0).all()) {
    throw NumericalError("log_likelihood: the covariance is not positive definite at length " + text_of(at.length_m));
  }
  factor.matrixL().solveInPlace(right);
  const Eigen::VectorXd along = right.rightCols<4>().transpose() * right.col(0);
  Eigen::Matrix4d precision = right.rightCols<4>().transpose() * right.rightCols<4>();
  precision.diagonal().array() += Eigen::Array4d(std::isinf(constant_sd) ? 0.0 : 1.0, 1.0, 1.0, 1.0);
  const Eigen::LLT<Eigen::Matrix4d> normal(precision);
  const double free_readings = static_cast<double>(n) - (std::isinf(constant_sd) ? 1.0 : 0.0);
  result -= diagonal.log().sum() + normal.matrixLLT().diagonal().array().log().sum();
  return result - 0.5 * (right.col(0).squaredNorm() - along.dot(normal.solve(along)) + free_readings * std::log(2.0 * std::numbers::pi));
}

}  // namespace palpation
