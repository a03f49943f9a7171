#include "palpation/certainty/edge_belief.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "boundary/outline_length.h"
#include "certainty/edge_belief_fit.h"
#include "certainty/edge_data.h"
#include "certainty/edge_starts.h"
#include "certainty/own_parts.h"
#include "palpation/base/error.h"
#include "readings/rounding.h"

namespace palpation {
namespace {

/// Mean squared residual over noise variance: what chance makes of a hundred readings is less.
constexpr double kMuchScatter = 1.3;
/// And over those degrees of freedom that are the noise's: chance makes more of a hundred readings.
constexpr double kLittleScatter = 0.5;
constexpr int kMostRounds = 4;
/// How often parts are looked for, each with those found before.
constexpr int kMostParts = 3;
/// Of two explanations, the one that is so much less likely is dropped: nats.
constexpr double kUnlikely = 3.9;

bool all_have_the_field_noise(std::span<const Palpation> palpations) {
  return std::ranges::all_of(palpations, [](const Palpation& one) {
    return std::isnan(one.noise_variance) || !one.set_aside.empty();
  });
}

/// Squared residuals over the noise variance, their sum.
double squares(const EdgeFit& fit, const EdgeData& data) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < data.reading.size(); ++i) {
    const double residual =
        data.reading[i] -
        profile_reading(fit.profile, data.part[i], data.depth_m[i] + fit.correction_m[i]);
    sum += residual * residual / data.variance[i];
  }
  return sum;
}

/// The same fit where all noise variances are `times` as large.
EdgeFit refitted(const EdgeFit& fit, double times, EdgeData& data,
                 const Eigen::MatrixXd& prior_covariance, const ProfilePrior& prior) {
  data = with_noise(times, std::move(data));
  EdgeFit next = fit_edge_belief(data, prior_covariance, prior);
  next.log_evidence += data.log_scatter;
  next.scatter = fit.scatter * times;
  return next;
}

/// Readings that scatter about the profile more than their noise says are believed that much less:
/// edges of real tissue are no perfect sigmoids. Where the noise was learned with the field, which
/// takes for noise what it cannot follow of a steep edge, those that scatter less are believed
/// more, as far as `least_variance`.
EdgeFit with_scatter(EdgeFit fit, EdgeData data, const Eigen::MatrixXd& prior_covariance,
                     const ProfilePrior& prior, bool noise_is_learned, double least_variance) {
  const Eigen::Index count = data.reading.size();
  for (int round = 0; noise_is_learned && round < kMostRounds; ++round) {
    // Of so many readings' worth of noise: what the fit has not followed (MacKay's measure).
    const double free = data.variance.dot(fit.covariance.inverse_diagonal());
    const double times =
        std::max(squares(fit, data) / free, least_variance / data.variance.minCoeff());
    if (!(times < kLittleScatter)) break;
    fit = refitted(fit, times, data, prior_covariance, prior);
  }
  for (int round = 0; round < kMostRounds; ++round) {
    const double scatter = squares(fit, data) / static_cast<double>(count);
    if (scatter < kMuchScatter) break;
    fit = refitted(fit, scatter, data, prior_covariance, prior);
  }
  return fit;
}

/// Of low, high, log slope, and how much higher than high each plateau of its own is.
ProfilePrior profile_prior(const Belief& belief, double least, double range,
                           const ShapePrior& shape, const OwnParts& parts) {
  const double sd = plateau_sd(belief, range), own_sd = shape.own_contrast_sd * range;
  int own = 0;
  for (const OwnPart& part : parts) own = std::max(own, part.plateau);
  ProfilePrior prior{ProfileParameters::Zero(kCommonParameters + own),
                     Eigen::VectorXd::Constant(kCommonParameters + own, own_sd * own_sd)};
  prior.mean.head<kCommonParameters>() << least, least + range, std::log(shape.slope_per_m);
  prior.variance.head<kCommonParameters>() << sd * sd, sd * sd,
      shape.slope_log_sd * shape.slope_log_sd;
  return prior;
}

/// Of a boundary that the fit takes as given. Without it noise would have parts of its own.
double price_of_freedom(const Surface& surface, const Field& depth, const ShapePrior& shape,
                        std::size_t readings) {
  double price = 0.0;
  for (const LevelLoop& loop : level_loops(surface, depth, 0.0))
    price += price_of_loop(outline_length(surface, {loop}), shape, readings);
  return price;
}

}  // namespace

/// What is fitted, whichever parts there are.
struct EdgeBelief::Task {
  const Belief& belief;
  const Field& field;
  std::span<const double> first_levels;
  double fraction;
  const ShapePrior& shape;
  double noise_log_sd;
};

double price_of_loop(double length_m, const ShapePrior& shape, std::size_t readings) {
  return 0.5 * std::log(static_cast<double>(readings)) *
         std::max(3.0, length_m / shape.correction_length_m);
}

double learned_noise_log_sd(int readings) {
  return readings > 0 ? 1.0 / std::sqrt(2.0 * readings) : 0.0;
}

EdgeBelief::EdgeBelief(Surface surface) : surface_(std::move(surface)) {}

std::optional<EdgeBelief> EdgeBelief::around(const Belief& belief, const Marginals& component,
                                             std::span<const double> first_levels, double fraction,
                                             const ShapePrior& shape, double noise_log_sd) {
  require(fraction > 0.0 && fraction < 1.0, "EdgeBelief", "fraction = " + text_of(fraction),
          "must lie in (0, 1)");
  require(noise_log_sd >= 0.0, "EdgeBelief", "noise_log_sd = " + text_of(noise_log_sd),
          "must not be negative");
  const Task task{belief, component.mean, first_levels, fraction, shape, noise_log_sd};
  std::optional<EdgeBelief> made = fitted(task, {}, component.mean.minCoeff());
  for (int round = 0; made && round < kMostParts; ++round) {
    const OwnParts parts = made->parts_apart(task.field);
    if (parts.size() < 2) break;
    const std::optional<EdgeBelief> free = fitted(task, parts, made->profile_.low);
    if (!free) break;
    made->weaker_.clear();
    const OwnParts told = free->told_apart(parts, made->weaker_);
    const bool more = told.size() > made->parts_.size();
    if (std::ranges::none_of(told, &OwnPart::plateau)) break;
    std::optional<EdgeBelief> next = fitted(task, told, free->profile_.low);
    if (!next || next->price() > made->price() + kUnlikely) break;
    const bool is_clear = next->price() < made->price() - kUnlikely;
    next->weaker_ = made->weaker_;
    made = is_clear ? std::move(next) : either(*std::move(made), *std::move(next));
    if (!more || !is_clear) break;
  }
  return made;
}

std::optional<EdgeBelief> EdgeBelief::fitted(const Task& task, const OwnParts& parts, double low) {
  const Belief& belief = task.belief;
  const ShapePrior& shape = task.shape;
  const Surface& surface = belief.prior().surface();
  EdgeData all = gathered_for_edge(belief);
  const double least = task.field.minCoeff(), range = task.field.maxCoeff() - least;
  if (all.places.empty() || !(range > 0.0)) return std::nullopt;
  const double profile_error = std::pow(shape.profile_error * range, 2);
  const double touch_variance = std::max(belief.noise_variance(), profile_error);
  all.variance = all.variance.cwiseMax(profile_error);

  const std::size_t readings = all.places.size();
  const ProfilePrior profile = profile_prior(belief, least, range, shape, parts);
  const std::vector<int> nearest = nearest_parts(Layout(belief.prior()), parts);
  const std::vector<Start> starts = likely_starts(
      belief, {task.field, task.first_levels, low, parts, nearest}, std::move(all), profile, shape);
  if (starts.empty()) return std::nullopt;
  const bool noise_is_learned =
      task.noise_log_sd > 0.0 && all_have_the_field_noise(belief.palpations());
  const double least_variance = std::max(profile_error, rounding_variance(belief.palpations()));
  EdgeBelief made(surface);
  made.noise_log_sd_ = task.noise_log_sd;
  std::vector<int> plateaus(nearest.size(), 0);
  for (std::size_t vertex = 0; vertex < plateaus.size() && !parts.empty(); ++vertex)
    plateaus[vertex] = parts[nearest[vertex]].plateau;
  for (const Start& start : starts) {
    const EdgeFit edge = with_scatter(start.edge, start.data, start.prior_covariance, profile,
                                      noise_is_learned, least_variance);
    Fit fit{start.correction,
            profile,
            task.fraction,
            touch_variance * edge.scatter,
            start.data,
            edge,
            start.distance,
            plateaus,
            start.edge.log_evidence,
            start.weight,
            1.0 / static_cast<double>(starts.size())};
    fit.depth = fit.depth_at_vertices();
    made.fits_.push_back(std::make_shared<const Fit>(std::move(fit)));
  }
  if (parts.size() > 1) made.name_parts(parts);
  made.mix();
  made.survey_boundary();
  made.freedom_ = price_of_freedom(surface, made.depth_, shape, readings);
  return made;
}

double EdgeBelief::log_evidence() const { return most_likely().edge.log_evidence - freedom_; }

/// Minus log evidence by the field's noise, which all that are compared share, and what freedom
/// costs.
double EdgeBelief::price() const { return freedom_ - most_likely().log_evidence; }

/// Two explanations, each as likely as its price says.
EdgeBelief EdgeBelief::either(EdgeBelief one, EdgeBelief other) {
  if (other.price() < one.price()) std::swap(one, other);
  const double odds = std::exp(one.price() - other.price());
  std::vector<std::shared_ptr<const Fit>> fits;
  for (const EdgeBelief* belief : {&one, &other}) {
    for (const std::shared_ptr<const Fit>& fit : belief->fits_) {
      Fit weighed = *fit;
      const double probability = (belief == &one ? 1.0 : odds) / (1.0 + odds);
      weighed.weight *= probability;
      weighed.alike *= probability;
      fits.push_back(std::make_shared<const Fit>(std::move(weighed)));
    }
  }
  one.fits_ = std::move(fits);
  one.mix();
  one.survey_boundary();
  return one;
}

/// What all fits say together, each as likely as the readings make it.
void EdgeBelief::mix() {
  profile_ = {.low = 0.0, .high = 0.0, .slope_per_m = 0.0, .shift_m = 0.0, .level = {}};
  depth_ = Field::Zero(surface_.vertex_count());
  double log_slope = 0.0, level_square = 0.0;
  noise_variance_ = most_likely().touch_variance;
  for (const auto& fit : fits_) {
    const double weight = fit->weight;
    const EdgeProfile one = fit->edge_profile();
    depth_ += weight * fit->depth;
    profile_.low += weight * one.low;
    profile_.high += weight * one.high;
    log_slope += weight * std::log(one.slope_per_m);
    profile_.shift_m += weight * one.shift_m;
    profile_.level.value += weight * one.level.value;
    noise_variance_ += weight * (fit->touch_variance - most_likely().touch_variance);
  }
  for (const auto& fit : fits_) {
    const Level one = fit->edge_profile().level;
    const double off = one.value - profile_.level.value;
    level_square += fit->weight * (*one.stddev * *one.stddev + off * off);
  }
  profile_.slope_per_m = std::exp(log_slope);
  profile_.level.stddev = std::sqrt(level_square);
}

}  // namespace palpation
