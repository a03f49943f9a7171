#include "exploration/heavy_tails.h"

#include <gtest/gtest.h>

#include <cmath>

#include "belief/tissue.h"
#include "palpation/boundary/level_set.h"
#include "palpation/boundary/region_error.h"
#include "palpation/exploration/exploration.h"
#include "palpation/world/phantom.h"

namespace palpation {
namespace {

/// Mean error over some runs in which one reading in twelve is off by a whole contrast, either way.
double wrong_mm2(bool heavy_tails) {
  const Surface tissue = plane(26, 51);
  const Phantom phantom(tissue, {Disk{Vec3(0.0115, 0.030, 0.0), 0.00625}}, {.noise = 0.05});
  const Region truth = superlevel_region(tissue, phantom.truth(), phantom.true_level());
  constexpr int kRuns = 3;
  double sum = 0.0;
  for (int seed = 1; seed <= kRuns; ++seed) {
    Exploration exploration(tissue, {.field = {.noise = {.heavy_tails = heavy_tails}}});
    Random random(static_cast<std::uint64_t>(seed));
    run(exploration, [&](const SurfacePoint& where, const Vec3&) {
      Palpation palpation = phantom.touch(where, random);
      if (random.below(12) == 0) palpation.reading += random.below(2) == 0 ? 2.0 : -2.0;
      return std::optional(palpation);
    });
    const Contour& contour = *exploration.conclusion().contour;
    sum += compare(tissue, superlevel_region(tissue, contour.field, contour.level), truth)
               .symmetric_difference_m2 *
           1e6;
  }
  return sum / kRuns;
}

TEST(HeavyTails, CostLessWhereTheyAreModelled) {
  EXPECT_LT(wrong_mm2(true), 0.7 * wrong_mm2(false));
}

TEST(HeavyTails, AResidualOfManyScalesLeavesAReadingHardlyAnyWeight) {
  const Surface tissue = plane(26, 51);
  std::vector<Palpation> palpations;
  for (int vertex = 0; vertex < tissue.vertex_count(); vertex += 7)
    palpations.push_back(touch(tissue, vertex, 7.0));
  palpations[40].reading = 8.0;
  const Prior flat(tissue, Metric::Chart, {.length_m = 0.05, .signal_sd = 0.1});
  const Belief belief = Belief(flat, {.noise_sd = 0.05}).condition_on(palpations);
  const WeighedReadings weighed = weighed_for_heavy_tails(belief, palpations, 0.05);
  const double usual = weighed.palpations[10].noise_variance;
  EXPECT_NEAR(usual, 0.8 * weighed.noise_sd * weighed.noise_sd,
              0.1 * usual);  // s^2 / w, w = 5 / 4 at no residual
  EXPECT_GT(weighed.palpations[40].noise_variance, 50.0 * usual);
}

// Weights about a field speak for it: those about a constant are asked for contrast.
TEST(HeavyTails, MakeNoTumourOfNoise) {
  const Surface tissue = plane(26, 51);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Random random(seed);
    std::vector<Palpation> palpations;
    for (int i = 0; i < 200; ++i) {
      const double far_out = seed % 2 == 0 && random.below(12) == 0 ? 8.0 : 1.0;
      palpations.push_back(touch(tissue, random.below(tissue.vertex_count()),
                                 7.0 + 0.1 * far_out * random.normal()));
    }
    Exploration exploration(tissue, {.field = {.noise = {.heavy_tails = true}}});
    exploration.take_up(palpations);
    EXPECT_FALSE(exploration.conclusion().evidence.contrast_seen) << seed;
  }
}

TEST(HeavyTails, DrawnInReadingsLieWithinTheRootOfFiveScales) {
  const Surface tissue = plane(26, 51);
  Random random(1);
  std::vector<Palpation> palpations;
  for (int i = 0; i < 400; ++i) palpations.push_back(touch(tissue, i, 7.0 + 0.1 * random.normal()));
  palpations[3].reading = 1e6;
  const std::vector<Palpation> drawn = drawn_in(palpations);
  EXPECT_NEAR(drawn[3].reading, 7.0 + std::sqrt(5.0) * 0.1,
              0.05);  // the weight's root falls as its distance grows
  for (const Palpation& palpation : drawn) EXPECT_LT(std::abs(palpation.reading - 7.0), 0.3);
}

TEST(HeavyTails, LeaveReadingsOfKnownNoiseAlone) {
  const Surface tissue = plane(26, 51);
  std::vector<Palpation> palpations = {touch(tissue, 0, 7.0), touch(tissue, 500, 7.1),
                                       touch(tissue, 900, 9.0)};
  palpations[2].noise_variance = 0.01;
  const Belief belief =
      Belief(Prior(tissue, Metric::Chart, {}), {.noise_sd = 0.1}).condition_on(palpations);
  EXPECT_EQ(weighed_for_heavy_tails(belief, palpations, 0.1).palpations[2].noise_variance, 0.01);
}

}  // namespace
}  // namespace palpation
