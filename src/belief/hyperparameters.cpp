#include "palpation/belief/hyperparameters.h"

#include <nlopt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "belief/field_not_fitted.h"
#include "belief/likelihood.h"
#include "belief/noise_alone.h"
#include "belief/sites.h"
#include "palpation/base/error.h"
#include "palpation/base/interruption.h"
#include "readings/readings.h"
#include "readings/rounding.h"

namespace palpation {
namespace {

constexpr double kRatioMedian = 0.02;  // of (noise / signal)^2
constexpr double kRatioSpread = 2.0;   // of its logarithm
constexpr double kLeastNoise = 1e-6;   // of the readings' range, where it is learned
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
  check_interruption();  // here, where nothing that is thrown passes through the optimizer
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

/// What a field must explain of the readings; never nothing.
double range_of(const NoiseAlone& alone, const Prior& prior, const std::vector<double>& readings) {
  const auto [least, greatest] = std::ranges::minmax(alone.residuals);
  const double range =
      greatest > least ? greatest - least : std::max(1e-12, std::abs(greatest) * 1e-12);
  // Around a plane, what is left of readings that lie on one is rounding.
  return prior.has_slope() ? std::max(range, kLeastNoise * std::abs(readings.front())) : range;
}

/// Logarithms that the optimizer may choose, where they must lie and where it starts.
struct Search {
  std::vector<double> lower, upper, from_start, from_prior;

  /// Its number; -1 of what is fixed.
  int add(const std::optional<double>& fixed, double least, double most, double first,
          double median) {
    if (fixed) return -1;
    lower.push_back(std::log(least));
    upper.push_back(std::log(most));
    from_start.push_back(std::log(first > 0.0 ? first : median));
    from_prior.push_back(std::log(median));
    return static_cast<int>(lower.size()) - 1;
  }
};

LengthRange lengths_to_search(const Prior& prior, const LearnOptions& options) {
  const double reach = options.likelihood_alone ? kReachAlone : 10.0;
  LengthRange searched{options.length_median_m / reach, options.length_median_m * reach};
  if (prior.metric() != Metric::Intrinsic || options.length_m) return searched;
  const LengthRange lengths = prior.lengths();
  require(lengths.least_m < lengths.most_m, "learn",
          "an intrinsic prior of one length, " + text_of(lengths.least_m) + " m,",
          "has no other to learn: give Prior the range, as lengths_to_learn has it");
  searched = {std::max(searched.least_m, lengths.least_m),
              std::min(searched.most_m, lengths.most_m)};
  require(searched.least_m < searched.most_m, "learn",
          "length_median_m = " + text_of(options.length_median_m),
          "must suit the lengths of the intrinsic prior, " + text_of(lengths.least_m) + " to " +
              text_of(lengths.most_m));
  return searched;
}

Search search_of(Objective& objective, const Prior& prior, const Hyperparameters& start,
                 double range) {
  const LearnOptions& options = objective.options;
  Search search;
  const LengthRange lengths = lengths_to_search(prior, options);
  objective.slot[0] = search.add(options.length_m, lengths.least_m, lengths.most_m, start.length_m,
                                 options.length_median_m);
  const double least_signal = options.likelihood_alone ? range / kReachAlone : 0.25 * range;
  const double most_signal = options.likelihood_alone ? range * kReachAlone : 10.0 * range;
  objective.slot[1] =
      search.add(options.signal_sd, least_signal, most_signal, start.signal_sd, 0.5 * range);
  const double signal = options.signal_sd.value_or(0.5 * range),
               start_signal = options.signal_sd.value_or(start.signal_sd);
  // Noise as a ratio to the signal; at() keeps it above the least noise where the signal is below
  // this one.
  objective.slot[2] =
      search.add(options.noise_sd, objective.least_noise / signal, 2.0 * range / signal,
                 start_signal > 0.0 ? start.noise_sd / start_signal : 0.0,
                 std::sqrt(kRatioMedian) * 0.5 * range / signal);
  return search;
}

/// From both starts. Returns the value at the given one; minus infinite where that is out of
/// bounds.
double climb_from_both(Objective& objective, Search search) {
  const double nowhere = -std::numeric_limits<double>::infinity();
  const auto& [lower, upper, from_start, from_prior] = search;
  if (lower.empty()) {
    nlopt_objective(0, nullptr, nullptr, &objective);
    return nowhere;
  }
  const std::vector<double> asked = from_start;
  for (std::vector<double>* x : {&search.from_prior, &search.from_start}) {
    for (std::size_t i = 0; i < x->size(); ++i) (*x)[i] = std::clamp((*x)[i], lower[i], upper[i]);
  }
  climb(objective, from_start, lower, upper);
  const double at_start = from_start == asked ? *objective.first : nowhere;
  if (!objective.options.likelihood_alone && from_prior != from_start)
    climb(objective, from_prior, lower, upper);
  return at_start;
}

/// The best point, or one nearby that is a multiple of the largest step there is among halvings of
/// one, for what it costs.
void round_best(Objective& objective, double nats, const Search& search) {
  const Optimum best = objective.best;
  if (nats == 0.0 || search.lower.empty() || !std::isfinite(best.value)) return;
  for (double step = 1.0; step > 1e-3; step *= 0.5) {
    std::vector<double> x = best.x;
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = std::clamp(step * std::round(x[i] / step), search.lower[i], search.upper[i]);
    objective.best = {};
    nlopt_objective(static_cast<unsigned>(x.size()), x.data(), nullptr, &objective);
    if (objective.best.value >= best.value - nats) return;
  }
  objective.best = best;
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
  const NoiseAlone alone = noise_alone(prior, sites, readings);
  // Around a plane, readings leave less than they were rounded by.
  const double rounding_sd = std::sqrt(rounding_variance(palpations));
  const double range = std::max(range_of(alone, prior, readings), rounding_sd);
  Objective objective{Likelihood(prior, sites),
                      options,
                      {options.length_m.value_or(0.0), options.signal_sd.value_or(0.0),
                       options.noise_sd.value_or(0.0)},
                      static_cast<double>(used_readings(palpations).size()),
                      std::max(kLeastNoise * range, rounding_sd),
                      {}};
  const Search search = search_of(objective, prior, start, range);
  const double at_start = climb_from_both(objective, search);
  round_best(objective, options.rounding_nats, search);
  const Optimum& best = objective.best;
  if (!std::isfinite(best.value)) {
    throw FieldNotFitted("learn", "no starting point gives a finite likelihood over " +
                                      std::to_string(sites.size()) + " places");
  }
  return {objective.at(best.x.data()), best.value, best.log_likelihood - alone.log_likelihood,
          best.value - at_start};
}

}  // namespace palpation
