#include "palpation/belief/hyperparameters.h"

#include <nlopt.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>

#include "belief/correlations.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kRatioMedian = 0.02;   // of (noise / signal)^2
constexpr double kRatioSpread = 2.0;    // of its logarithm
constexpr double kLeastNoise = 1e-6;    // of the readings' range, where it is learned
constexpr double kNoiseFreeLog = 30.0;  // how far below the readings' own variance that of noise is looked for: 1e-6 in standard deviation
constexpr int kMostEvaluations = 100;

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

struct Objective {
  const Prior& prior;
  const std::vector<Site>& sites;
  const LearnOptions& options;
  Hyperparameters fixed;
  std::array<int, 3> slot{-1, -1, -1};  // of length, signal, noise among the free variables

  Hyperparameters at(const double* x) const {
    Hyperparameters values = fixed;
    if (slot[0] >= 0) values.length_m = std::exp(x[slot[0]]);
    if (slot[1] >= 0) values.signal_sd = std::exp(x[slot[1]]);
    if (slot[2] >= 0) values.noise_sd = std::exp(x[slot[2]]);
    return values;
  }

  /// Log posterior and its gradient by the logarithms.
  LikelihoodGradient operator()(const double* x) const {
    const Hyperparameters values = at(x);
    LikelihoodGradient result = likelihood_gradient(prior, sites, values);
    if (slot[0] >= 0) {
      const double z = std::log(values.length_m / options.length_median_m) / options.length_spread;
      result.value -= 0.5 * z * z;
      result.gradient[0] -= z / options.length_spread;
    }
    if (slot[1] >= 0 && slot[2] >= 0) {
      const double z = (2.0 * std::log(values.noise_sd / values.signal_sd) - std::log(kRatioMedian)) / kRatioSpread;
      result.value -= 0.5 * z * z;
      result.gradient[1] += 2.0 * z / kRatioSpread;
      result.gradient[2] -= 2.0 * z / kRatioSpread;
    }
    return result;
  }
};

double nlopt_objective(unsigned, const double* x, double* gradient, void* context) {
  const auto& objective = *static_cast<const Objective*>(context);
  try {
    const LikelihoodGradient result = objective(x);
    for (int parameter = 0; parameter < 3; ++parameter) {
      if (gradient != nullptr && objective.slot[parameter] >= 0) gradient[objective.slot[parameter]] = result.gradient[parameter];
    }
    return result.value;
  } catch (const NumericalError&) {
    return -std::numeric_limits<double>::infinity();  // outside what double precision can factor
  }
}

struct Optimum {
  std::vector<double> x;
  double value = -std::numeric_limits<double>::infinity();
};

Optimum climb(Objective& objective, std::vector<double> x, const std::vector<double>& lower, const std::vector<double>& upper) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::clamp(x[i], lower[i], upper[i]);
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimizer(nlopt_create(NLOPT_LD_LBFGS, static_cast<unsigned>(x.size())),
                                                                         &nlopt_destroy);
  nlopt_set_lower_bounds(optimizer.get(), lower.data());
  nlopt_set_upper_bounds(optimizer.get(), upper.data());
  nlopt_set_max_objective(optimizer.get(), nlopt_objective, &objective);
  nlopt_set_xtol_abs1(optimizer.get(), 1e-5);
  nlopt_set_ftol_abs(optimizer.get(), 1e-8);
  nlopt_set_maxeval(optimizer.get(), kMostEvaluations);
  Optimum best{x, nlopt_objective(0, x.data(), nullptr, &objective)};
  double value = 0.0;
  nlopt_optimize(optimizer.get(), x.data(), &value);  // what it returns on failure is still the best point it saw
  value = nlopt_objective(0, x.data(), nullptr, &objective);
  return value > best.value ? Optimum{x, value} : best;
}

void check_fixed(const char* name, const std::optional<double>& value, bool zero_allowed) {
  if (!value) return;
  require(std::isfinite(*value) && (*value > 0.0 || (zero_allowed && *value == 0.0)), "learn", std::string(name) + " = " + text_of(*value),
          zero_allowed ? "must be finite and not negative" : "must be positive and finite");
}

using Tilts = Eigen::Matrix<double, Eigen::Dynamic, 3>;

Tilts tilts_of(const Prior& prior, std::span<const Site> sites) {
  Tilts tilts(sites.size(), 3);
  for (std::size_t i = 0; i < sites.size(); ++i) tilts.row(static_cast<Eigen::Index>(i)) = prior.tilt(sites[i].place.coordinates);
  return tilts;
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

/// The readings as independent draws around a plane: what a field must explain better.
struct Plane {
  double log_likelihood = -std::numeric_limits<double>::infinity();
  std::vector<double> residuals;  ///< up to a constant
};

/// Around one unknown constant, their variance the best one.
Plane noise_around_constant(const std::vector<double>& readings) {
  const double n = static_cast<double>(readings.size());
  double mean = 0.0, square = 0.0;
  for (double reading : readings) mean += reading / n;
  for (double reading : readings) square += (reading - mean) * (reading - mean);
  const double variance = square / (n - 1.0);
  if (variance <= 0.0) return {std::numeric_limits<double>::infinity(), readings};
  return {-0.5 * ((n - 1.0) * (std::log(2.0 * std::numbers::pi * variance) + 1.0) + std::log(n)), readings};
}

/// Around an unknown constant and a slope of the prior's, the variance the best of a row of values a tenth apart in logarithm.
Plane noise_around_plane(const Prior& prior, std::span<const Site> sites, const std::vector<double>& readings) {
  const double n = static_cast<double>(readings.size());
  Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(readings.data(), static_cast<Eigen::Index>(readings.size()));
  y.array() -= y.mean();
  Tilts tilts = tilts_of(prior, sites);
  tilts.rowwise() -= tilts.colwise().mean().eval();
  const Eigen::Matrix3d gram = tilts.transpose() * tilts;
  const Vec3 along = tilts.transpose() * y;
  const double square = y.squaredNorm();
  if (square <= 0.0) return noise_around_constant(readings);
  Plane best;
  for (double log_variance = std::log(square / n); log_variance > std::log(square / n) - kNoiseFreeLog; log_variance -= 0.1) {
    const double variance = std::exp(log_variance);
    const Eigen::LLT<Eigen::Matrix3d> precision(Eigen::Matrix3d::Identity() + gram / variance);
    const Vec3 tilt = precision.solve(along / variance);
    const double log_likelihood =
        -0.5 * ((n - 1.0) * (std::log(2.0 * std::numbers::pi) + log_variance) + std::log(n) + (square - along.dot(tilt)) / variance) -
        precision.matrixLLT().diagonal().array().log().sum();
    if (!(log_likelihood > best.log_likelihood)) continue;
    const Eigen::VectorXd residuals = y - tilts * tilt;
    best = {log_likelihood, {residuals.begin(), residuals.end()}};
  }
  return best;
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
  const Eigen::LLT<Eigen::MatrixXd> factor(s);
  const auto diagonal = factor.matrixLLT().diagonal().array();
  if (factor.info() != Eigen::Success || !diagonal.isFinite().all() || !(diagonal > 0.0).all()) {
    throw NumericalError("likelihood_gradient: the covariance is not positive definite at length " + text_of(at.length_m));
  }
  Eigen::MatrixXd p = factor.solve(Eigen::MatrixXd::Identity(n, n));
  result.value -= diagonal.log().sum();
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

Learned learn(const Prior& prior, std::span<const Palpation> palpations, const Hyperparameters& start, const LearnOptions& options) {
  check_fixed("length_m", options.length_m, false);
  check_fixed("signal_sd", options.signal_sd, false);
  check_fixed("noise_sd", options.noise_sd, true);
  const std::vector<Site> sites = gather_sites(prior, palpations);
  require(sites.size() >= 2, "learn", std::to_string(sites.size()) + " touched places", "are too few: two are needed");

  std::vector<double> readings;
  for (const Site& site : sites) readings.push_back(merge(site, 1.0).mean);
  const Plane plane = prior.has_slope() ? noise_around_plane(prior, sites, readings) : noise_around_constant(readings);
  const auto [least, greatest] = std::minmax_element(plane.residuals.begin(), plane.residuals.end());
  double range = *greatest > *least ? *greatest - *least : std::max(1e-12, std::abs(*greatest) * 1e-12);
  // Around a plane, what is left of readings that lie on one is rounding.
  if (prior.has_slope()) range = std::max(range, kLeastNoise * std::abs(readings.front()));

  Objective objective{
      prior, sites, options, {options.length_m.value_or(0.0), options.signal_sd.value_or(0.0), options.noise_sd.value_or(0.0)}, {}};
  std::vector<double> lower, upper, from_start, from_prior;
  const auto free_variable = [&](int parameter, const std::optional<double>& fixed_value, double least_value, double most, double first,
                                 double median) {
    objective.slot[parameter] = -1;
    if (fixed_value) return;
    objective.slot[parameter] = static_cast<int>(lower.size());
    lower.push_back(std::log(least_value));
    upper.push_back(std::log(most));
    from_start.push_back(std::log(first > 0.0 ? first : median));
    from_prior.push_back(std::log(median));
  };
  double least_length_m = options.length_median_m * 0.1, most_length_m = options.length_median_m * 10.0;
  if (prior.metric() == Metric::Intrinsic && !options.length_m) {
    const LengthRange lengths = prior.lengths();
    require(lengths.least_m < lengths.most_m, "learn", "an intrinsic prior of one length, " + text_of(lengths.least_m) + " m,",
            "has no other to learn: give Prior the range, as lengths_to_learn has it");
    least_length_m = std::max(least_length_m, lengths.least_m);
    most_length_m = std::min(most_length_m, lengths.most_m);
    require(least_length_m < most_length_m, "learn", "length_median_m = " + text_of(options.length_median_m),
            "must suit the lengths of the intrinsic prior, " + text_of(lengths.least_m) + " to " + text_of(lengths.most_m));
  }
  free_variable(0, options.length_m, least_length_m, most_length_m, start.length_m, options.length_median_m);
  free_variable(1, options.signal_sd, 0.25 * range, 10.0 * range, start.signal_sd, 0.5 * range);
  free_variable(2, options.noise_sd, kLeastNoise * range, 2.0 * range, start.noise_sd, std::sqrt(kRatioMedian) * 0.5 * range);

  Optimum best;
  if (lower.empty()) {
    best = {{}, nlopt_objective(0, nullptr, nullptr, &objective)};
  } else {
    best = climb(objective, from_prior, lower, upper);
    const Optimum other = climb(objective, from_start, lower, upper);
    if (other.value > best.value) best = other;
  }
  if (!std::isfinite(best.value)) {
    throw NumericalError("learn: no starting point gives a finite likelihood over " + std::to_string(sites.size()) + " places");
  }
  Learned learned{objective.at(best.x.data()), best.value, 0.0};
  learned.signal_evidence = likelihood_gradient(prior, sites, learned.values).value - plane.log_likelihood;
  return learned;
}

}  // namespace palpation
