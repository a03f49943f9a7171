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

#include "belief/likelihood.h"
#include "belief/sites.h"
#include "belief/tilts.h"
#include "palpation/base/error.h"
#include "readings/readings.h"
#include "readings/rounding.h"

namespace palpation {
namespace {

constexpr double kRatioMedian = 0.02;   // of (noise / signal)^2
constexpr double kRatioSpread = 2.0;    // of its logarithm
constexpr double kLeastNoise = 1e-6;    // of the readings' range, where it is learned
constexpr double kNoiseFreeLog = 30.0;  // how far below the readings' own variance that of noise is
                                        // looked for: 1e-6 in standard deviation
constexpr int kMostEvaluations = 100;
constexpr double kReachAlone = 1000.0;  // of length and signal about their medians, without priors

/// The best point that a search has seen.
struct Optimum {
  std::vector<double> x;
  double value = -std::numeric_limits<double>::infinity();
  double log_likelihood = 0.0;
};

struct Objective {
  Likelihood likelihood;
  const LearnOptions& options;
  Hyperparameters fixed;
  double readings;     // how many
  double least_noise;  // where it is learned
  std::array<int, 3> slot{
      -1, -1, -1};  // of the logarithms of length, signal, noise / signal among the free variables
  Optimum best{};
  std::optional<double> first{};  // log posterior where the search began

  Hyperparameters at(const double* x) const {
    Hyperparameters values = fixed;
    if (slot[0] >= 0) values.length_m = std::exp(x[slot[0]]);
    if (slot[1] >= 0) values.signal_sd = std::exp(x[slot[1]]);
    if (slot[2] >= 0)
      values.noise_sd = std::max(least_noise, values.signal_sd * std::exp(x[slot[2]]));
    return values;
  }

  /// Log posterior and its gradient by the variables; remembers the best.
  LikelihoodGradient operator()(const double* x, unsigned count) {
    const Hyperparameters values = at(x);
    LikelihoodGradient result = likelihood(values);
    const double log_likelihood = result.value;
    if (!options.likelihood_alone) add_priors(values, result);
    if (slot[2] >= 0 && values.noise_sd == least_noise) result.gradient[2] = 0.0;
    if (slot[2] >= 0) result.gradient[1] += result.gradient[2];  // signal and noise together
    if (!first) first = result.value;
    if (result.value > best.value) best = {{x, x + count}, result.value, log_likelihood};
    return result;
  }

  void add_priors(const Hyperparameters& values, LikelihoodGradient& result) const {
    if (slot[0] >= 0) {
      const double z = std::log(values.length_m / options.length_median_m) / options.length_spread;
      result.value -= 0.5 * z * z;
      result.gradient[0] -= z / options.length_spread;
    }
    if (slot[1] >= 0 && slot[2] >= 0) {
      const double z =
          (2.0 * std::log(values.noise_sd / values.signal_sd) - std::log(kRatioMedian)) /
          kRatioSpread;
      result.value -= 0.5 * z * z;
      result.gradient[1] += 2.0 * z / kRatioSpread;
      result.gradient[2] -= 2.0 * z / kRatioSpread;
    }
  }
};

double nlopt_objective(unsigned count, const double* x, double* gradient, void* context) {
  auto& objective = *static_cast<Objective*>(context);
  try {
    const LikelihoodGradient result = objective(x, count);
    for (int parameter = 0; parameter < 3; ++parameter) {
      if (gradient != nullptr && objective.slot[parameter] >= 0)
        gradient[objective.slot[parameter]] = result.gradient[parameter];
    }
    return result.value;
  } catch (const NumericalError&) {  // outside what double precision can factor
    if (!objective.first) objective.first = -std::numeric_limits<double>::infinity();
    return -std::numeric_limits<double>::infinity();
  }
}

/// Signal and noise times the factor that suits the readings best, which one gradient tells: y'
/// S^-1 y is `readings` there, and falls with the factor's square.
void scale(Objective& objective, std::vector<double>& x, const std::vector<double>& lower,
           const std::vector<double>& upper) {
  std::array<double, 3> gradient{};
  const double here =
      nlopt_objective(static_cast<unsigned>(x.size()), x.data(), gradient.data(), &objective);
  const auto signal = static_cast<std::size_t>(objective.slot[1]);
  const double square = 1.0 + gradient[signal] / objective.readings;
  if (std::isfinite(here) && square > 0.0)
    x[signal] = std::clamp(x[signal] + 0.5 * std::log(square), lower[signal], upper[signal]);
}

/// Whatever the optimizer returns, the objective knows the best point it saw.
void climb(Objective& objective, std::vector<double> x, const std::vector<double>& lower,
           const std::vector<double>& upper) {
  if (objective.slot[1] >= 0 && objective.slot[2] >= 0) scale(objective, x, lower, upper);
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimizer(
      nlopt_create(NLOPT_LD_LBFGS, static_cast<unsigned>(x.size())), &nlopt_destroy);
  nlopt_set_lower_bounds(optimizer.get(), lower.data());
  nlopt_set_upper_bounds(optimizer.get(), upper.data());
  nlopt_set_max_objective(optimizer.get(), nlopt_objective, &objective);
  nlopt_set_xtol_abs1(optimizer.get(), 1e-5);
  nlopt_set_ftol_abs(optimizer.get(), 1e-6);
  nlopt_set_maxeval(optimizer.get(), kMostEvaluations);
  double value = 0.0;
  nlopt_optimize(optimizer.get(), x.data(), &value);
}

void check_fixed(const char* name, const std::optional<double>& value, bool zero_allowed) {
  if (!value) return;
  require(std::isfinite(*value) && (*value > 0.0 || (zero_allowed && *value == 0.0)), "learn",
          std::string(name) + " = " + text_of(*value),
          zero_allowed ? "must be finite and not negative" : "must be positive and finite");
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
  return {-0.5 * ((n - 1.0) * (std::log(2.0 * std::numbers::pi * variance) + 1.0) + std::log(n)),
          readings};
}

/// Around an unknown constant and a slope of the prior's, the variance the best of a row of values
/// a tenth apart in logarithm.
Plane noise_around_plane(const Prior& prior, std::span<const Site> sites,
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
  if (square <= 0.0) return noise_around_constant(readings);
  Plane best;
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

Learned learn(const Prior& prior, std::span<const Palpation> palpations,
              const Hyperparameters& start, const LearnOptions& options) {
  check_fixed("length_m", options.length_m, false);
  check_fixed("signal_sd", options.signal_sd, false);
  check_fixed("noise_sd", options.noise_sd, true);
  const std::vector<Site> sites = gather_sites(prior, palpations);
  require(sites.size() >= 2, "learn", std::to_string(sites.size()) + " touched places",
          "are too few: two are needed");

  std::vector<double> readings;
  for (const Site& site : sites) readings.push_back(merge(site, 1.0).mean);
  const Plane plane = prior.has_slope() ? noise_around_plane(prior, sites, readings)
                                        : noise_around_constant(readings);
  const auto [least, greatest] =
      std::minmax_element(plane.residuals.begin(), plane.residuals.end());
  double range =
      *greatest > *least ? *greatest - *least : std::max(1e-12, std::abs(*greatest) * 1e-12);
  // Around a plane, what is left of readings that lie on one is rounding.
  if (prior.has_slope()) range = std::max(range, kLeastNoise * std::abs(readings.front()));

  Objective objective{Likelihood(prior, sites),
                      options,
                      {options.length_m.value_or(0.0), options.signal_sd.value_or(0.0),
                       options.noise_sd.value_or(0.0)},
                      static_cast<double>(used_readings(palpations).size()),
                      std::max(kLeastNoise * range, std::sqrt(rounding_variance(palpations))),
                      {}};
  std::vector<double> lower, upper, from_start, from_prior;
  const auto free_variable = [&](int parameter, const std::optional<double>& fixed_value,
                                 double least_value, double most, double first, double median) {
    objective.slot[parameter] = -1;
    if (fixed_value) return;
    objective.slot[parameter] = static_cast<int>(lower.size());
    lower.push_back(std::log(least_value));
    upper.push_back(std::log(most));
    from_start.push_back(std::log(first > 0.0 ? first : median));
    from_prior.push_back(std::log(median));
  };
  const double length_reach = options.likelihood_alone ? kReachAlone : 10.0;
  double least_length_m = options.length_median_m / length_reach,
         most_length_m = options.length_median_m * length_reach;
  if (prior.metric() == Metric::Intrinsic && !options.length_m) {
    const LengthRange lengths = prior.lengths();
    require(lengths.least_m < lengths.most_m, "learn",
            "an intrinsic prior of one length, " + text_of(lengths.least_m) + " m,",
            "has no other to learn: give Prior the range, as lengths_to_learn has it");
    least_length_m = std::max(least_length_m, lengths.least_m);
    most_length_m = std::min(most_length_m, lengths.most_m);
    require(least_length_m < most_length_m, "learn",
            "length_median_m = " + text_of(options.length_median_m),
            "must suit the lengths of the intrinsic prior, " + text_of(lengths.least_m) + " to " +
                text_of(lengths.most_m));
  }
  free_variable(0, options.length_m, least_length_m, most_length_m, start.length_m,
                options.length_median_m);
  const double least_signal = options.likelihood_alone ? range / kReachAlone : 0.25 * range;
  const double most_signal = options.likelihood_alone ? range * kReachAlone : 10.0 * range;
  free_variable(1, options.signal_sd, least_signal, most_signal, start.signal_sd, 0.5 * range);
  const double signal = options.signal_sd.value_or(0.5 * range),
               start_signal = options.signal_sd.value_or(start.signal_sd);
  // Noise as a ratio to the signal; at() keeps it above the least noise where the signal is below
  // this one.
  free_variable(2, options.noise_sd, objective.least_noise / signal, 2.0 * range / signal,
                start_signal > 0.0 ? start.noise_sd / start_signal : 0.0,
                std::sqrt(kRatioMedian) * 0.5 * range / signal);

  double at_start = -std::numeric_limits<double>::infinity();
  if (lower.empty()) {
    nlopt_objective(0, nullptr, nullptr, &objective);
  } else {
    const std::vector<double> asked = from_start;
    for (std::vector<double>* x : {&from_prior, &from_start}) {
      for (std::size_t i = 0; i < x->size(); ++i) (*x)[i] = std::clamp((*x)[i], lower[i], upper[i]);
    }
    climb(objective, from_start, lower, upper);
    if (from_start == asked) at_start = *objective.first;
    if (!options.likelihood_alone && from_prior != from_start)
      climb(objective, from_prior, lower, upper);
  }
  const Optimum& best = objective.best;
  if (!std::isfinite(best.value)) {
    throw NumericalError("learn: no starting point gives a finite likelihood over " +
                         std::to_string(sites.size()) + " places");
  }
  return {objective.at(best.x.data()), best.value, best.log_likelihood - plane.log_likelihood,
          best.value - at_start};
}

}  // namespace palpation
