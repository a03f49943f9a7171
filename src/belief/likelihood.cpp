#include "belief/likelihood.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "belief/correlations.h"
#include "belief/tilts.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

/// d log(scatter likelihood) / d log(noise sd), and d (merged variance, merged mean) / d log(noise
/// sd).
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
  return {plain_square / noise_variance - count + share, 2.0 * merged.variance * share,
          2.0 * share * (merged.mean - plain_mean)};
}

/// The sums over all elements of a a' - P times those of K, and times those of its slope.
std::pair<double, double> along(const Eigen::VectorXd& a, const Eigen::MatrixXd& p,
                                const PairCorrelations& k) {
  double by_value = 0.0, by_slope = 0.0;
  Eigen::VectorXd column(a.size());
  for (Eigen::Index j = 0, rest = a.size(); rest > 0; ++j, --rest) {
    auto below = column.head(rest);
    below = a[j] * a.tail(rest) - p.col(j).tail(rest);
    below[0] *= 0.5;  // the diagonal counts once
    by_value += 2.0 * below.dot(k.value().col(j).tail(rest));
    by_slope += 2.0 * below.dot(k.slope().col(j).tail(rest));
  }
  return {by_value, by_slope};
}

}  // namespace

Likelihood::Likelihood(const Prior& prior, std::span<const Site> sites)
    : prior_(prior), sites_(sites), correlations_(prior, sites) {
  const auto n = static_cast<Eigen::Index>(sites.size());
  p_.resize(n, n);
  for (Eigen::VectorXd* values : {&readings_, &variances_, &variance_slopes_, &mean_slopes_})
    values->resize(n);
}

void Likelihood::merge_readings(double noise_variance, LikelihoodGradient& result) {
  for (std::size_t site = 0; site < sites_.size(); ++site) {
    const auto i = static_cast<Eigen::Index>(site);
    const MergedReading merged = merge(sites_[site], noise_variance);
    const NoiseSlopes slopes = noise_slopes(sites_[site], merged, noise_variance);
    readings_[i] = merged.mean;
    variances_[i] = merged.variance;
    variance_slopes_[i] = slopes.variance;
    mean_slopes_[i] = slopes.mean;
    result.value += scatter_log_likelihood(sites_[site], noise_variance);
    result.gradient[2] += slopes.scatter;
  }
}

/// P - P 1 1' P / (1' P 1 + 1 / sd^2); returns what that adds to the log likelihood besides the
/// change of P.
double Likelihood::integrate_constant_out() {
  const double sd = prior_.constant().sd;
  if (sd == 0.0) return 0.0;
  const double constant_precision = 1.0 / (sd * sd);  // 0 if infinite
  const Eigen::VectorXd weights =
      p_.selfadjointView<Eigen::Lower>() * Eigen::VectorXd::Ones(p_.rows());
  const double precision = weights.sum() + constant_precision;
  p_.selfadjointView<Eigen::Lower>().rankUpdate(weights, -1.0 / precision);
  return -0.5 * std::log(std::isinf(sd) ? precision : precision / constant_precision);
}

/// P - P H (I + H' P H)^-1 H' P with H = Prior::tilt at the sites, where the prior has a slope;
/// returns as above.
double Likelihood::integrate_slope_out() {
  if (!prior_.has_slope()) return 0.0;
  const Tilts tilts = tilts_of(prior_, sites_);
  const Tilts weights = p_.selfadjointView<Eigen::Lower>() * tilts;
  const Eigen::LLT<Eigen::Matrix3d> precision(Eigen::Matrix3d::Identity() +
                                              tilts.transpose() * weights);
  const Eigen::Matrix3Xd roots = precision.matrixL().solve(weights.transpose());
  p_.selfadjointView<Eigen::Lower>().rankUpdate(roots.transpose(), -1.0);
  return -precision.matrixLLT().diagonal().array().log().sum();
}

/// P begins as S^-1 with S = signal^2 K + D; of both the lower half.
LikelihoodGradient Likelihood::operator()(const Hyperparameters& at) {
  const double signal_variance = at.signal_sd * at.signal_sd;
  LikelihoodGradient result;
  merge_readings(at.noise_sd * at.noise_sd, result);
  correlations_.set_length(at.length_m);
  p_.triangularView<Eigen::Lower>() = signal_variance * correlations_.value();
  p_.diagonal() += variances_;
  const std::optional<double> log_determinant = inverse_(p_);
  if (!log_determinant)
    throw NumericalError("likelihood: the covariance is not positive definite at length " +
                         text_of(at.length_m));
  result.value += integrate_constant_out() - 0.5 * *log_determinant;
  result.value += integrate_slope_out();

  // Readings are taken relative to one of them where the constant is unknown: P 1 = 0 then, so only
  // rounding changes.
  const bool is_constant_unknown = std::isinf(prior_.constant().sd);
  const double free_readings =
      static_cast<double>(sites_.size()) - (is_constant_unknown ? 1.0 : 0.0);
  const Eigen::VectorXd residuals = readings_.array() - (is_constant_unknown ? readings_[0] : 0.0);
  const Eigen::VectorXd a = p_.selfadjointView<Eigen::Lower>() * residuals;
  result.value -= 0.5 * (residuals.dot(a) + free_readings * std::log(2.0 * std::numbers::pi));

  const auto [along_value, along_slope] = along(a, p_, correlations_);
  result.gradient[0] = 0.5 * signal_variance * along_slope;
  result.gradient[1] = signal_variance * along_value;
  result.gradient[2] +=
      0.5 * ((a.array().square() - p_.diagonal().array()) * variance_slopes_.array()).sum() -
      a.dot(mean_slopes_);
  return result;
}

LikelihoodGradient likelihood_gradient(const Prior& prior, std::span<const Site> sites,
                                       const Hyperparameters& at) {
  return Likelihood(prior, sites)(at);
}

/// With L L' = S, w = L^-1 (y - origin) and H = L^-1 (the constant and the slope, each over its
/// prior's standard deviation): log p = -(w'w - w'H (I + H'H)^-1 H'w + log|S| + log|I + H'H| + n
/// log 2 pi) / 2, without I for a constant that is not known at all.
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
  // Readings are taken relative to one of them where the constant is not known: rounding is all
  // that changes.
  if (std::isinf(constant_sd)) right.col(0).array() -= right(0, 0);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(s);
  const auto diagonal = s.diagonal().array();
  if (factor.info() != Eigen::Success || !diagonal.isFinite().all() || !(diagonal > 0.0).all()) {
    throw NumericalError("log_likelihood: the covariance is not positive definite at length " +
                         text_of(at.length_m));
  }
  factor.matrixL().solveInPlace(right);
  const Eigen::VectorXd along = right.rightCols<4>().transpose() * right.col(0);
  Eigen::Matrix4d precision = right.rightCols<4>().transpose() * right.rightCols<4>();
  precision.diagonal().array() +=
      Eigen::Array4d(std::isinf(constant_sd) ? 0.0 : 1.0, 1.0, 1.0, 1.0);
  const Eigen::LLT<Eigen::Matrix4d> normal(precision);
  const double free_readings = static_cast<double>(n) - (std::isinf(constant_sd) ? 1.0 : 0.0);
  result -= diagonal.log().sum() + normal.matrixLLT().diagonal().array().log().sum();
  return result - 0.5 * (right.col(0).squaredNorm() - along.dot(normal.solve(along)) +
                         free_readings * std::log(2.0 * std::numbers::pi));
}

}  // namespace palpation
