// Tissue that breathes while it is touched: an outline that followed its readings would be sure and
// wrong.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "palpation/base/random.h"
#include "palpation/exploration/conclusion.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

constexpr double kRadius_m = 0.008, kNoise = 0.08;  // of a contrast of 2
const Vec3 kMiddle(0.017, 0.018, 0.0);

Surface tissue() {
  Random random(0);
  return Surface(make_plane({.size_m = {0.035, 0.035}, .columns = 51, .rows = 51}, random));
}

/// By so much to either side, once in 40 of 120 readings.
Conclusion concluded(double by_m, std::uint64_t seed) {
  Random random(seed);
  const Surface surface = tissue();
  std::vector<Palpation> felt;
  for (int i = 0; i < 120; ++i) {
    const Vec3 place(0.0005 + 0.034 * random.uniform(), 0.0005 + 0.034 * random.uniform(), 0.0),
        lies = kMiddle + by_m * std::sin(2.0 * std::numbers::pi * i / 40.0) * Vec3(0.6, -0.8, 0.0);
    const double depth_m = kRadius_m - (place - lies).norm();
    felt.push_back(
        {.where = surface.project(place),
         .reading = 7.0 + 2.0 / (1.0 + std::exp(-1400.0 * depth_m)) + kNoise * random.normal()});
  }
  const Model model{.level = {.estimate = LevelEstimate::Edge}};
  return conclude(surface, model, felt, nullptr, 1);
}

/// Of the true outline, in scores of the band, where it is farthest from what was found.
double farthest(const Conclusion& conclusion) {
  const Surface& surface = conclusion.belief.prior().surface();
  double most = 0.0;
  for (int i = 0; i < 360; ++i) {
    const double angle = i * std::numbers::pi / 180.0;
    const Vec3 place = kMiddle + kRadius_m * Vec3(std::cos(angle), std::sin(angle), 0.0);
    most = std::max(
        most, std::abs(surface.interpolate(conclusion.certainty->score, surface.project(place))));
  }
  return most / conclusion.certainty->band_score;
}

TEST(WanderingPlaces, OfTissueThatBreathesAreInTheBand) {
  const Conclusion all = concluded(0.0025, 1);
  ASSERT_TRUE(all.outlines && all.certainty);
  ASSERT_TRUE(all.outlines->misfit.wandering);
  EXPECT_TRUE(all.outlines->misfit.wandering->is_sure());
  EXPECT_LT(farthest(all), 1.0);
}

TEST(WanderingPlaces, OfTissueThatRestsAreNone) {
  const Conclusion all = concluded(0.0, 1);
  ASSERT_TRUE(all.outlines && all.certainty);
  EXPECT_FALSE(all.outlines->misfit.wandering);
  EXPECT_LT(farthest(all), 1.0);
}

}  // namespace
}  // namespace palpation
