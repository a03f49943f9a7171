#include "palpation/decision/acquisition.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "base/normal.h"
#include "belief/covariance_with.h"
#include "decision/scoring.h"
#include "palpation/base/error.h"
#include "palpation/base/random.h"

namespace palpation {
namespace {

constexpr std::size_t kLookedAt = 200;
constexpr double kTellsNothing = 1e-6;  // of the variance

void check_gamma(const char* function, double gamma) {
  require(gamma >= 0.0 && gamma <= 1.0, function, "gamma = " + text_of(gamma),
          "must lie in [0, 1]");
}

void check_width(const char* function, double width) {
  require(std::isfinite(width) && width >= 0.0, function, "width = " + text_of(width),
          "must be finite and not negative");
}

}  // namespace

Pointwise evr() {
  return {.score = [](double, double stddev, const Level&) { return stddev; },
          .grows_with_stddev = true};
}

Pointwise ucb(double gamma, Scaling scaling) {
  check_gamma("ucb", gamma);
  return {.score = [gamma](double mean, double stddev,
                           const Level&) { return gamma * mean + (1.0 - gamma) * stddev; },
          .grows_with_stddev = true,
          .units = scaling == Scaling::Raw ? Units::Readings : Units::OverGreatestMean};
}

Pointwise ils_ucb(double gamma, Scaling scaling) {
  check_gamma("ils_ucb", gamma);
  return {.score =
              [gamma](double mean, double stddev, const Level& level) {
                return (1.0 - gamma) * stddev - gamma * std::abs(mean - level.value);
              },
          .grows_with_stddev = true,
          .units = scaling == Scaling::Raw ? Units::Readings : Units::OverGreatestDistance};
}

Pointwise straddle(double width) {
  check_width("straddle", width);
  return {.score =
              [width](double mean, double stddev, const Level& level) {
                return width * stddev - std::abs(mean - level.value);
              },
          .grows_with_stddev = true};
}

Pointwise lse_ambiguity(double width) {
  check_width("lse_ambiguity", width);
  return {.score =
              [width](double mean, double stddev, const Level& level) {
                return std::min(mean + width * stddev - level.value,
                                level.value - (mean - width * stddev));
              },
          .grows_with_stddev = true};
}

Whole randomized_straddle(std::uint64_t seed) {
  return {.scores = [seed](const Belief& belief, const Level& level) {
    Random random(seed ^ (0x9e3779b97f4a7c15u * (belief.palpations().size() + 1)));
    return score(straddle(std::sqrt(-2.0 * std::log1p(-random.uniform()))), belief, level);
  }};
}

Whole expected_symmetric_difference() {
  return {.scores = [](const Belief& belief, const Level& level) {
    const Surface& surface = belief.prior().surface();
    const Marginals now = belief.at_vertices();
    const Field liked = score(straddle(), belief, level);
    std::vector<int> order(static_cast<std::size_t>(liked.size()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return liked[a] > liked[b]; });
    order.resize(std::min(order.size(), kLookedAt));

    Field gains = Field::Zero(liked.size());
    Field covariance(liked.size());
    for (const int candidate : order) {
      CovarianceWith(belief, candidate)(0, static_cast<int>(covariance.size()), covariance.data());
      const double reading_variance = now.variance[candidate] + belief.noise_variance();
      if (!(reading_variance > 0.0)) continue;
      for (int vertex = 0; vertex < covariance.size(); ++vertex) {
        const double before = now.variance[vertex];
        const double known =
            std::min(covariance[vertex] * covariance[vertex] / reading_variance, before);
        if (!(known > kTellsNothing * before)) continue;
        const double z = std::abs(now.mean[vertex] - level.value) / std::sqrt(before);
        const double misjudged = owens_t(z, std::numeric_limits<double>::infinity()) -
                                 owens_t(z, std::sqrt((before - known) / known));
        gains[candidate] += surface.vertex_areas()[vertex] * 2.0 * misjudged;
      }
    }
    return gains;
  }};
}

Whole random_scores(std::uint64_t seed) {
  return {.scores = [seed](const Belief& belief, const Level&) {
    Random random(seed ^ (0x9e3779b97f4a7c15u * (belief.palpations().size() + 1)));
    Field scores(belief.prior().surface().vertex_count());
    for (double& score : scores) score = random.uniform();
    return scores;
  }};
}

PointwiseScorer::PointwiseScorer(const Pointwise& acquisition, const Level& level,
                                 const Marginals& marginals, std::span<const int> candidates)
    : acquisition_(acquisition), level_(level), is_scaled_(acquisition.units != Units::Readings) {
  if (!is_scaled_) return;
  mean_origin_ = acquisition.units == Units::OverGreatestDistance ? level.value : 0.0;
  double greatest_stddev = 0.0;
  double greatest_mean = 0.0;
  for (int vertex : candidates) {
    greatest_stddev = std::max(greatest_stddev, std::sqrt(marginals.variance[vertex]));
    greatest_mean = std::max(greatest_mean, std::abs(marginals.mean[vertex] - mean_origin_));
  }
  if (greatest_stddev > 0.0) stddev_unit_ = greatest_stddev;
  if (greatest_mean > 0.0) mean_unit_ = greatest_mean;
}

void PointwiseScorer::refuse(double mean, double variance) {
  require(false, "Acquisition",
          "the score at mean " + text_of(mean) + ", variance " + text_of(variance),
          "must not be NaN");
}

Marginals planning_marginals(const Belief& belief) {
  Marginals marginals = belief.at_vertices();
  if (belief.prior().has_slope()) marginals.mean = belief.at_vertices(Part::Detrended).mean;
  return marginals;
}

Field score(const Acquisition& acquisition, const Belief& belief, const Level& level) {
  if (const auto* whole = std::get_if<Whole>(&acquisition)) return whole->scores(belief, level);
  const Marginals marginals = planning_marginals(belief);
  std::vector<int> all(static_cast<std::size_t>(marginals.mean.size()));
  std::iota(all.begin(), all.end(), 0);
  const PointwiseScorer scorer(std::get<Pointwise>(acquisition), level, marginals, all);
  Field scores(marginals.mean.size());
  for (Eigen::Index vertex = 0; vertex < scores.size(); ++vertex)
    scores[vertex] = scorer(marginals.mean[vertex], marginals.variance[vertex]);
  return scores;
}

}  // namespace palpation
