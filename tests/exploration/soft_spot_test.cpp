#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "palpation/base/random.h"
#include "palpation/exploration/conclusion.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/readings/screening.h"

namespace palpation {
namespace {

constexpr double kRadius_m = 0.009;

double off_middle(const Vec3& place) { return (place - Vec3(0.018, 0.022, 0.0)).norm(); }

/// A raster over 7 beside a tumour that stands out by so much, and 6 within a spot in its middle.
Conclusion concluded(double spot_m, double contrast = 1.0, double noise = 0.05) {
  Random random(1);
  const Surface surface(make_plane({.size_m = {0.04, 0.05}, .columns = 41, .rows = 51}, random));
  std::vector<Palpation> palpations;
  for (int row = 0; row < 16; ++row) {
    for (int i = 0; i < 13; ++i) {
      const Vec3 place(0.002 + 0.003 * (row % 2 == 0 ? i : 12 - i), 0.0025 + 0.003 * row, 0.0);
      const double off_m = off_middle(place);
      const double stiffness =
          off_m < spot_m ? 6.0 : 7.0 + contrast / (1.0 + std::exp(-1200.0 * (kRadius_m - off_m)));
      palpations.push_back(
          {.where = surface.project(place), .reading = stiffness + noise * random.normal()});
    }
  }
  return conclude(surface, {.level = {.estimate = LevelEstimate::Edge}}, palpations, nullptr, 1);
}

std::ptrdiff_t soft_spots(const Conclusion& conclusion) {
  return std::ranges::count(conclusion.palpations, kSoftSpot, &Palpation::set_aside);
}

// As deep below healthy tissue as the tumour stands out, so that no gap tells them apart.
TEST(SoftSpot, OfContactThatWasLostOverATumourHidesItNot) {
  const Conclusion conclusion = concluded(0.0055);
  EXPECT_GE(soft_spots(conclusion), 8);
  ASSERT_TRUE(conclusion.outlines);
  EXPECT_NEAR(conclusion.outlines->area_m2.mean * 1e6, std::numbers::pi * 81.0, 40.0);
}

// The noise leaves no gap below healthy tissue, as contact that is lost at once does.
TEST(SoftSpot, MakesNoTumourOfHealthyTissue) {
  const Conclusion conclusion = concluded(0.0055, 0.0, 0.15);
  EXPECT_GE(soft_spots(conclusion), 8);
  EXPECT_FALSE(conclusion.level);
}

TEST(SoftSpot, IsNoneWithoutOne) { EXPECT_EQ(soft_spots(concluded(0.0)), 0); }

}  // namespace
}  // namespace palpation
