#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/normal.h"
#include "palpation/base/random.h"
#include "palpation/decision/acquisition.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

constexpr Level kLevel{8.0, {}};

Belief belief_of_noise(int count) {
  Random random(3);
  const Surface tissue(make_plane({.size_m = {0.02, 0.02}, .columns = 15, .rows = 15}, random));
  const Belief blank(Prior(tissue, Metric::Chart, Kernel{.length_m = 0.004, .signal_sd = 1.0}),
                     {.noise_sd = 0.2});
  std::vector<Palpation> palpations;
  for (int i = 0; i < count; ++i) {
    const auto vertex = static_cast<int>(random.uniform() * tissue.vertex_count());
    palpations.push_back({.where = tissue.at_vertex(vertex), .reading = 8.0 + random.normal()});
  }
  return blank.condition_on(palpations);
}

double misjudged_m2(const Belief& before, const Belief& after) {
  const Marginals now = before.at_vertices(), then = after.at_vertices();
  double sum = 0.0;
  for (Eigen::Index vertex = 0; vertex < now.mean.size(); ++vertex) {
    const double known = now.variance[vertex] - then.variance[vertex];
    const double z = std::abs(now.mean[vertex] - kLevel.value) / std::sqrt(now.variance[vertex]);
    const double ratio = known > 0.0 ? std::sqrt(then.variance[vertex] / known)
                                     : std::numeric_limits<double>::infinity();
    sum += before.prior().surface().vertex_areas()[vertex] * 2.0 * owens_t(z, ratio);
  }
  return sum;
}

TEST(ExpectedSymmetricDifference, IsWhatTheTouchItselfTakesAway) {
  const Belief belief = belief_of_noise(12);
  const Field gains = expected_symmetric_difference().scores(belief, kLevel);
  const Surface& tissue = belief.prior().surface();
  for (int vertex = 0; vertex < tissue.vertex_count(); vertex += 7) {
    if (gains[vertex] == 0.0) continue;
    const Palpation touch{.where = tissue.at_vertex(vertex), .reading = 8.0};
    const double taken = misjudged_m2(belief, belief) -
                         misjudged_m2(belief, belief.condition_on(std::span(&touch, 1)));
    EXPECT_NEAR(gains[vertex], taken, 1e-9 * tissue.area());
  }
  EXPECT_GT(gains.maxCoeff(), 0.0);
  EXPECT_GE(gains.minCoeff(), 0.0);
}

TEST(RandomizedStraddle, DrawsAnewForEveryPickAndTheSameForTheSameSeed) {
  const Belief fewer = belief_of_noise(8), more = belief_of_noise(9);
  const Whole one = randomized_straddle(1), two = randomized_straddle(2);
  EXPECT_EQ(one.scores(fewer, kLevel), randomized_straddle(1).scores(fewer, kLevel));
  EXPECT_NE(one.scores(fewer, kLevel), two.scores(fewer, kLevel));
  // Its width is what the scores at the level's own places show: score = width sd - |mean - level|.
  const auto width = [](const Whole& acquisition, const Belief& belief) {
    const Marginals now = belief.at_vertices();
    return (acquisition.scores(belief, kLevel)[0] + std::abs(now.mean[0] - kLevel.value)) /
           std::sqrt(now.variance[0]);
  };
  EXPECT_GT(width(one, fewer), 0.0);
  EXPECT_NE(width(one, fewer), width(one, more));
}

}  // namespace
}  // namespace palpation
