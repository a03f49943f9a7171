#include "palpation/certainty/edge_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "palpation/base/error.h"
#include "palpation/base/random.h"
#include "palpation/certainty/level_estimate.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

/// Of the phantoms: plateaus 7 and 9, 1,400 per metre.
double profile(double depth_m) { return 7.0 + 2.0 / (1.0 + std::exp(-1400.0 * depth_m)); }

constexpr EdgePrior kPrior{.plateau = 8.0, .plateau_sd = 2.0};

/// Readings every quarter of a millimetre from first to last depth, with noise of the given
/// standard deviation.
std::vector<EdgeReading> readings(double first_mm, double last_mm, double shift_mm, double noise_sd,
                                  Random& random) {
  std::vector<EdgeReading> made;
  for (double depth = first_mm; depth <= last_mm; depth += 0.25) {
    made.push_back({depth / 1000.0,
                    profile((depth + shift_mm) / 1000.0) + noise_sd * random.normal(),
                    noise_sd * noise_sd});
  }
  return made;
}

TEST(FitEdge, FindsTheProfileThatReadingsLieOn) {
  Random random(1);
  // Noise of 1e-6 that is not there: priors then weigh nothing.
  std::vector<EdgeReading> exact = readings(-6.0, 5.0, 0.3, 0.0, random);
  for (EdgeReading& reading : exact) reading.variance = 1e-12;
  const EdgeProfile found = fit_edge(exact, 0.7, kPrior);
  EXPECT_NEAR(found.low, 7.0, 1e-6);
  EXPECT_NEAR(found.high, 9.0, 1e-6);
  EXPECT_NEAR(found.slope_per_m, 1400.0, 1e-2);
  EXPECT_NEAR(found.shift_m, 0.0003, 1e-9);
  EXPECT_NEAR(found.level.value, 8.4, 1e-6);
}

TEST(FitEdge, KnowsHowWellItKnowsTheLevel) {
  Random random(2);
  double squares = 0.0;
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Level level = fit_edge(readings(-5.0, 5.0, 0.2, 0.2, random), 0.5, kPrior).level;
    squares += std::pow((level.value - 8.0) / *level.stddev, 2) / kTrials;
  }
  // The mean of 400 squared standard normal values has the standard deviation 0.07.
  EXPECT_NEAR(squares, 1.0, 0.3);
}

TEST(FitEdge, IsUnsureWhereOneSideWasNeverTouched) {
  Random random(3);
  const Level both = fit_edge(readings(-5.0, 5.0, 0.0, 0.1, random), 0.5, kPrior).level;
  const Level outside = fit_edge(readings(-8.0, -3.0, 0.0, 0.1, random), 0.5, kPrior).level;
  EXPECT_LT(*both.stddev, 0.05);
  EXPECT_GT(*outside.stddev, 0.5);  // half of what the prior knows of the other plateau
  const std::vector<EdgeReading> one{{.depth_m = 0.001, .reading = 8.5, .variance = 0.01}};
  EXPECT_GT(*fit_edge(one, 0.5, kPrior).level.stddev, 0.5);
}

TEST(FitEdge, DoesNotMindTheUnitOfTheReadings) {
  Random random(4);
  const std::vector<EdgeReading> plain = readings(-5.0, 4.0, 0.1, 0.1, random);
  std::vector<EdgeReading> scaled = plain;
  for (EdgeReading& reading : scaled) {
    reading.reading = 1000.0 * reading.reading - 5.0;
    reading.variance *= 1e6;
  }
  const Level one = fit_edge(plain, 0.5, kPrior).level;
  const Level other = fit_edge(scaled, 0.5, {.plateau = 7995.0, .plateau_sd = 2000.0}).level;
  // The steps end when the misfit rests to 1e-10.
  EXPECT_NEAR(other.value, 1000.0 * one.value - 5.0, 1e-2);
  EXPECT_NEAR(*other.stddev, 1000.0 * *one.stddev, 1e-2);
}

TEST(FitEdge, RefusesWhatIsNoReading) {
  const std::vector<EdgeReading> good{{.depth_m = 0.001, .reading = 8.5, .variance = 0.01}};
  EXPECT_THROW(fit_edge({}, 0.5, kPrior), InvalidInput);
  EXPECT_THROW(fit_edge(good, 1.0, kPrior), InvalidInput);
  for (const EdgeReading& bad : {EdgeReading{0.001, 8.5, 0.0}, EdgeReading{0.001, NAN, 0.01},
                                 EdgeReading{INFINITY, 8.5, 0.01}}) {
    EXPECT_THROW(fit_edge(std::vector{bad}, 0.5, kPrior), InvalidInput);
  }
  EXPECT_THROW(fit_edge(good, 0.5, {.plateau_sd = 0.0}), InvalidInput);
}

/// A sheet of 25 x 30 mm with a disk, touched on a grid.
struct Scene {
  Surface tissue;
  Belief belief;
  Marginals marginals;
};

Scene touched(const Vec3& centre, double radius_m, double noise, int every) {
  Random random(5);
  const Surface tissue(make_plane({.size_m = {0.025, 0.030}, .columns = 51, .rows = 61}, random));
  std::vector<Palpation> palpations;
  for (int row = 0; row < 61; row += every) {
    for (int column = 0; column < 51; column += every) {
      const SurfacePoint where = tissue.at_vertex(51 * row + column);
      const double depth_m = radius_m - (tissue.position(where) - centre).norm();
      palpations.push_back(
          {.where = where, .reading = profile(depth_m) + 2.0 * noise * random.normal()});
    }
  }
  const Belief belief = Belief(Prior(tissue, Metric::Chart, {.length_m = 0.0035}),
                               {.noise_sd = std::max(2.0 * noise, 1e-3)})
                            .condition_on(palpations);
  return {tissue, belief, belief.at_vertices()};
}

TEST(LevelFromEdge, IsTheTruthToWithinThreeOfItsStandardDeviations) {
  for (const double noise : {0.0, 0.05, 0.2}) {
    const Scene scene = touched({0.012, 0.014, 0.0}, 0.006, noise, 4);
    const Level level = level_from_edge(scene.tissue, scene.belief, scene.marginals, 0.5);
    EXPECT_LT(std::abs(level.value - 8.0), 3.0 * *level.stddev) << noise;
    EXPECT_LT(*level.stddev, 0.02 + 0.5 * noise) << noise;
  }
}

// A narrow tumour never shows its plateau: the greatest mean lies below it, and a level from the
// range with it.
TEST(LevelFromEdge, DoesNotNeedToSeeTheGreatestReading) {
  const Scene scene = touched({0.012, 0.014, 0.0}, 0.0015, 0.01, 2);
  const double by_edge = level_from_edge(scene.tissue, scene.belief, scene.marginals, 0.5).value;
  const double by_range = level_from_range(scene.marginals, 0.5).value;
  EXPECT_LT(std::abs(by_edge - 8.0), std::abs(by_range - 8.0));
}

TEST(LevelFromEdge, TakesTheTissuesBorderForNoEdge) {
  const Scene scene = touched({0.0, 0.0, 0.0}, 0.012, 0.01, 4);
  const Level level = level_from_edge(scene.tissue, scene.belief, scene.marginals, 0.5);
  EXPECT_NEAR(level.value, 8.0, 0.05);
}

TEST(LevelFromEdge, SaysHalfTheRangeWhereNothingIsKnown) {
  Random random(6);
  const Surface tissue(make_plane({.size_m = {0.01, 0.01}, .columns = 5, .rows = 5}, random));
  const Belief belief(Prior(tissue, Metric::Chart, {.length_m = 0.0035}), {.noise_sd = 0.1});
  const Level untouched = level_from_edge(tissue, belief, belief.at_vertices(), 0.5);
  EXPECT_EQ(untouched.stddev, 0.0);  // of a mean that is the same everywhere
  const Belief once =
      belief.condition_on(std::vector<Palpation>{{.where = tissue.at_vertex(12), .reading = 7.0}});
  const Level single = level_from_edge(tissue, once, once.at_vertices(), 0.5);
  EXPECT_TRUE(std::isfinite(single.value));
  EXPECT_GE(*single.stddev, 0.0);
}

}  // namespace
}  // namespace palpation
