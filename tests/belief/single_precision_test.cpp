#include <gtest/gtest.h>

#include <cmath>

#include "belief/covariance_with.h"
#include "belief/tissue.h"
#include "palpation/base/error.h"
#include "palpation/belief/belief.h"
#include "palpation/decision/batch.h"

namespace palpation {
namespace {

constexpr double kBound = 1e-4;  // stated with BeliefOptions::single_precision, of the signal

std::vector<Palpation> touches(const Surface& surface, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Palpation> all;
  for (int i = 0; i < count; ++i)
    all.push_back({.where = surface.at_vertex(random.below(surface.vertex_count())),
                   .reading = random.normal()});
  return all;
}

/// In batches of ten, as a run takes them in.
Belief grown(const Prior& prior, const BeliefOptions& options, const std::vector<Palpation>& all) {
  Belief belief(prior, options);
  for (std::size_t first = 0; first < all.size(); first += 10)
    belief = belief.condition_on(
        std::span(all).subspan(first, std::min<std::size_t>(10, all.size() - first)));
  return belief;
}

TEST(SinglePrecision, StaysWithinItsBoundDownToTheLeastNoiseItIsAllowedFor) {
  const Surface surface = plane(51, 101);
  const std::vector<Palpation> all = touches(surface, 205, 3);
  for (const KernelFamily family : {KernelFamily::SquaredExponential, KernelFamily::Matern52}) {
    for (const double noise_variance : {kLeastNoiseForSingle, 1e-2, 1e-1}) {
      for (const Constant constant : {Constant{.sd = 0.0}, Constant{}}) {
        const Prior prior(surface, Metric::Chart, {.family = family, .length_m = 0.0033}, constant);
        const double noise_sd = std::sqrt(noise_variance) * (1.0 + 1e-12);
        const Belief exact = grown(prior, {.noise_sd = noise_sd}, all);
        const Belief single = grown(prior, {.noise_sd = noise_sd, .single_precision = true}, all);
        const Marginals expected = exact.at_vertices(), found = single.at_vertices();
        EXPECT_LT((expected.mean - found.mean).cwiseAbs().maxCoeff(), kBound) << noise_variance;
        EXPECT_LT((expected.variance - found.variance).cwiseAbs().maxCoeff(), kBound)
            << noise_variance;
        EXPECT_GT((expected.variance - found.variance).cwiseAbs().maxCoeff(), 0.0)
            << "nothing was kept in single precision";
        std::vector<double> expected_row(100), found_row(100);
        CovarianceWith(exact, 2000)(1990, 100, expected_row.data());
        CovarianceWith(single, 2000)(1990, 100, found_row.data());
        for (int i = 0; i < 100; ++i) EXPECT_NEAR(expected_row[i], found_row[i], kBound);
      }
    }
  }
}

TEST(SinglePrecision, ForeseesAndTakesBackAsDoubleDoes) {
  const Surface surface = plane(51, 101);
  const std::vector<Palpation> all = touches(surface, 60, 5);
  const Prior prior(surface, Metric::Chart, {.length_m = 0.0033});
  const Belief before =
      grown(prior, {.noise_sd = 0.1, .single_precision = true}, {all.begin(), all.begin() + 50});
  std::vector<SurfacePoint> places;
  for (int i = 50; i < 60; ++i) places.push_back(all[i].where);
  const std::span<const Palpation> last = std::span(all).subspan(50);
  const Marginals planned = before.foresee(places).condition_on(last).at_vertices(),
                  plain = before.condition_on(last).at_vertices();
  EXPECT_LT((planned.mean - plain.mean).cwiseAbs().maxCoeff(), kBound);
  EXPECT_LT((planned.variance - plain.variance).cwiseAbs().maxCoeff(), kBound);
}

TEST(SinglePrecision, IsRefusedWhereNoiseIsTooLow) {
  const Surface surface = plane(26, 51);
  const Prior prior(surface, Metric::Chart, {.length_m = 0.0033});
  const Belief blank(prior, {.noise_sd = 0.03, .single_precision = true});
  EXPECT_THROW(blank.condition_on(touches(surface, 3, 1)), InvalidInput);
}

}  // namespace
}  // namespace palpation
