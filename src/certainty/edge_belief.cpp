#include "palpation/certainty/edge_belief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "base/normal.h"
#include "certainty/boundary_nodes.h"
#include "certainty/edge_belief_fit.h"
#include "certainty/edge_data.h"
#include "palpation/base/error.h"
#include "palpation/boundary/level_set.h"
#include "readings/rounding.h"

namespace palpation {
namespace {

/// Readings without noise still scatter about the profile, as much as the model of the edge is
/// wrong: a thousandth of the range.
constexpr double kModelError = 1e-3;
/// Mean squared residual over noise variance: what chance makes of a hundred readings is less.
constexpr double kMuchScatter = 1.3;
/// And over those degrees of freedom that are the noise's: chance makes more of a hundred readings.
constexpr double kLittleScatter = 0.5;
constexpr int kMostRounds = 4;
/// Laplace's approximation takes the profile as straight. Where the boundary may be off by a good
/// part of the edge's width, readings tell less than that: the offset's variance grows by this much
/// for a standard deviation of 1 / slope (found on simulated tumours).
constexpr double kCurved = 3.0;
/// Its tails are heavier than a normal's, and so are the outlines': a missed arm, a corner. The
/// band is this many times as wide as Rice's formula has it (found on the worlds of seeds 0 to 64).
constexpr double kHeavyTail = 1.8;

/// Gauss and Hermite's five nodes for the mean over a standard normal variable.
constexpr std::array<std::pair<double, double>, 5> kNormalNodes = {
    {{-2.856970013872806, 0.011257411327720691},
     {-1.355626179974266, 0.22207592200561266},
     {0.0, 8.0 / 15.0},
     {1.355626179974266, 0.22207592200561266},
     {2.856970013872806, 0.011257411327720691}}};

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
        data.reading[i] - profile_reading(fit.profile, data.depth_m[i] + fit.correction_m[i]);
    sum += residual * residual / data.variance[i];
  }
  return sum;
}

/// The same fit where all noise variances are `times` as large.
EdgeFit refitted(const EdgeFit& fit, double times, EdgeData& data,
                 const Eigen::MatrixXd& prior_covariance, const ProfilePrior& prior) {
  data.variance *= times;
  EdgeFit next = fit_edge_belief(data, prior_covariance, prior);
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
    const double free =
        data.variance.dot(fit.covariance.solve(Eigen::MatrixXd::Identity(count, count)).diagonal());
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

/// What outlines may be like: most of them smooth all along, one in five with corners.
struct OutlinePrior {
  KernelFamily family;
  double ShapePrior::*length_m;
  double probability;
};
constexpr std::array kOutlines = {
    OutlinePrior{KernelFamily::Matern52, &ShapePrior::correction_length_m, 0.8},
    OutlinePrior{KernelFamily::Matern32, &ShapePrior::corner_length_m, 0.2}};

/// A first boundary and what it becomes under one kind of outline.
struct Start {
  Prior correction;
  EdgeData data;
  Eigen::MatrixXd prior_covariance;
  EdgeFit edge;
  Eigen::VectorXd distance;
  double weight = 1.0;  ///< posterior probability
};

/// For each kind of outline the first boundary that makes the readings most probable, the most
/// likely kind first.
std::vector<Start> likely_starts(const Belief& belief, const Field& field,
                                 std::span<const double> first_levels, EdgeData all,
                                 const ProfilePrior& profile, const ShapePrior& shape) {
  const Layout layout(belief.prior());
  const Surface& surface = layout.surface();
  // On a plane all metrics are one: the intrinsic one needs no waves there.
  const bool as_believed = surface.is_planar() && belief.prior().metric() != Metric::Intrinsic;
  std::array<std::optional<Start>, kOutlines.size()> best;
  for (const double first_level : first_levels) {
    Eigen::VectorXd distance;
    if (!measure_depths(layout, field, first_level, distance, all)) continue;
    const EdgeData data = with_plateaus_merged(all);
    for (std::size_t kind = 0; kind < kOutlines.size(); ++kind) {
      const Kernel kernel{.family = kOutlines[kind].family,
                          .length_m = shape.*kOutlines[kind].length_m,
                          .signal_sd = shape.correction_sd_m};
      const Prior correction(surface, as_believed ? belief.prior().metric() : layout.metric(),
                             kernel, Constant{.sd = 0.0});
      Eigen::MatrixXd prior_covariance = correction.covariance(data.places, data.places);
      EdgeFit edge = fit_edge_belief(data, prior_covariance, profile);
      if (best[kind] && !(edge.log_evidence > best[kind]->edge.log_evidence)) continue;
      best[kind] = Start{correction, data, std::move(prior_covariance), std::move(edge), distance};
    }
    if (all.reading.size() > kMany)
      break;  // what is merged differs from start to start, and so does the evidence
  }
  std::vector<Start> starts;
  for (std::size_t kind = 0; kind < kOutlines.size(); ++kind) {
    if (!best[kind]) continue;
    starts.push_back(std::move(*best[kind]));
    starts.back().weight = starts.back().edge.log_evidence + std::log(kOutlines[kind].probability);
  }
  std::ranges::sort(starts, std::greater{}, &Start::weight);
  double sum = 0.0;
  const double most = starts.empty() ? 0.0 : starts.front().weight;
  for (Start& start : starts) sum += start.weight = std::exp(start.weight - most);
  for (Start& start : starts) start.weight /= sum;
  return starts;
}

}  // namespace

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
  const Surface& surface = belief.prior().surface();
  EdgeData all = gathered_for_edge(belief);
  const double least = component.mean.minCoeff(), range = component.mean.maxCoeff() - least;
  if (all.places.empty() || !(range > 0.0)) return std::nullopt;
  const double model_variance = kModelError * kModelError * range * range;
  const double touch_variance = std::max(belief.noise_variance(), model_variance);
  all.variance = all.variance.cwiseMax(model_variance);

  const double plateau_variance = shape.plateau_error * shape.plateau_error * range * range;
  const ProfilePrior profile{
      {least, least + range, std::log(shape.slope_per_m)},
      {plateau_variance, plateau_variance, shape.slope_log_sd * shape.slope_log_sd}};
  const std::vector<Start> starts =
      likely_starts(belief, component.mean, first_levels, std::move(all), profile, shape);
  if (starts.empty()) return std::nullopt;
  const bool noise_is_learned = noise_log_sd > 0.0 && all_have_the_field_noise(belief.palpations());
  const double least_variance = std::max(model_variance, rounding_variance(belief.palpations()));
  EdgeBelief made(surface);
  made.noise_log_sd_ = noise_log_sd;
  for (const Start& start : starts) {
    const EdgeFit edge = with_scatter(start.edge, start.data, start.prior_covariance, profile,
                                      noise_is_learned, least_variance);
    Fit fit{start.correction, profile, fraction,    touch_variance * edge.scatter,
            start.data,       edge,    start.weight};
    fit.depth = fit.depth_at_vertices(start.distance);
    made.fits_.push_back(std::make_shared<const Fit>(std::move(fit)));
  }
  made.mix();
  made.survey_boundary();
  return made;
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

/// Offsets at nodes along the boundary: how sure they are, and how they go together. Where the
/// boundary lies, the readings decide between the kinds of outline. How sure that is, they do not:
/// corners are few, and what most of an outline is like says little of the rest, so for that both
/// kinds count alike.
void EdgeBelief::survey_boundary() {
  const BoundaryNodes nodes = boundary_nodes(surface_, depth_);
  const auto count = static_cast<Eigen::Index>(nodes.points.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
  for (const auto& fit : fits_) {
    Eigen::VectorXd off(count);
    for (Eigen::Index node = 0; node < count; ++node)
      off[node] = surface_.interpolate(fit->depth, nodes.points[node]);
    covariance += fit->depth_covariance(nodes.points) + off * off.transpose();
  }
  covariance /= static_cast<double>(fits_.size());
  const Eigen::VectorXd as_if_straight = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  const Eigen::ArrayXd part_of_edge = as_if_straight.array() * profile_.slope_per_m;
  const Eigen::VectorXd sd =
      as_if_straight.array() * (1.0 + kCurved * part_of_edge.square()).sqrt();
  for (std::size_t i = 0; i < nodes.points.size(); ++i) {
    const auto here = static_cast<Eigen::Index>(i), before = here - 1;
    expected_error_m2_ += std::sqrt(2.0 / std::numbers::pi) * nodes.length_m[i] * sd[here];
    if (!nodes.follows_last[i]) continue;
    const double scale = as_if_straight[here] * as_if_straight[before];
    if (scale > 0.0) turn_ += std::acos(std::clamp(covariance(here, before) / scale, -1.0, 1.0));
  }
  offset_sd_ = spread_from_nodes(Layout(most_likely().correction), nodes, sd);
}

double EdgeBelief::band_score(double probability) const {
  const auto misses_at = [&](double q) {
    return 2.0 * (1.0 - normal_probability(q)) +
           2.0 * turn_ / (2.0 * std::numbers::pi) * std::exp(-0.5 * q * q);
  };
  const auto misses = [&](double q) {
    double sum = 0.0;
    for (const auto& [z, weight] : kNormalNodes)
      sum += weight * misses_at(q * std::exp(noise_log_sd_ * z));
    return sum;
  };
  double below = 0.0, above = 40.0;
  for (double middle = 20.0; below < middle && middle < above;
       middle = below + 0.5 * (above - below)) {
    (misses(middle) > 1.0 - probability ? below : above) = middle;
  }
  return kHeavyTail * above;
}

}  // namespace palpation
