// How far softer tissue reaches about what was found, by readings topped at its height.
#include "exploration/softer_reach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "belief/tissue.h"

namespace palpation {
namespace {

constexpr double kCore_m = 0.004, kRim_m = 0.008;
const Vec3 kMiddle(0.0125, 0.025, 0.0);

double disk(const Vec3& place, double radius_m) {
  return 1.0 / (1.0 + std::exp(2000.0 * ((place - kMiddle).norm() - radius_m)));
}

/// From 120 readings with a noise of 3 % of the contrast, so many of them about the tumour.
Conclusion felt(double rim, std::uint64_t seed) {
  const Surface tissue = plane(26, 51);
  Random random(seed);
  std::vector<Palpation> readings;
  for (int i = 0; i < 120; ++i) {
    const int vertex = static_cast<int>(random.below(tissue.vertex_count()));
    const Vec3 place = tissue.vertex(vertex);
    const double share = std::max(disk(place, kCore_m), rim * disk(place, kRim_m));
    readings.push_back(
        {.where = tissue.at_vertex(vertex), .reading = 7.0 + 2.0 * share + 0.06 * random.normal()});
  }
  return conclude(tissue, Model{}, readings);
}

double inside_m2(const Conclusion& conclusion, const Field& depth) {
  const Surface& surface = conclusion.belief.prior().surface();
  return (depth.array() >= 0.0).select(surface.vertex_areas().array(), 0.0).sum();
}

TEST(SofterReach, IsThatOfARimAboutACore) {
  const double rim_m2 = std::numbers::pi * kRim_m * kRim_m;
  double mean_m2 = 0.0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Conclusion conclusion = felt(0.48, seed);
    ASSERT_TRUE(conclusion.edge);
    const std::optional<SofterReach> softer = softer_reach(conclusion);
    ASSERT_TRUE(softer);
    mean_m2 += inside_m2(conclusion, softer->edge.depth()) / 5.0;
  }
  EXPECT_NEAR(mean_m2, rim_m2, 0.15 * rim_m2);
}

TEST(SofterReach, LeavesNothingUnexplainedOfOneHeight) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Conclusion conclusion = felt(1.0, seed);
    ASSERT_TRUE(conclusion.edge);
    const std::optional<SofterReach> softer = softer_reach(conclusion);
    ASSERT_TRUE(softer);
    EXPECT_LT(softer->unexplained_m2, conclusion.edge->expected_error_m2());
  }
}

/// Of ten recordings, on average.
double unexplained_m2(double rim) {
  double mean_m2 = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    mean_m2 += softer_reach(felt(rim, seed)).value().unexplained_m2 / 10.0;
  return mean_m2;
}

TEST(SofterReach, IsUnexplainedOfARimBelowTheLineHalfWayUp) {
  EXPECT_GT(unexplained_m2(0.42), 5.0 * unexplained_m2(1.0) + 1e-6);
}

}  // namespace
}  // namespace palpation
