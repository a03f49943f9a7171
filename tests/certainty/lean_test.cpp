// How a slope differs by side: its waves by hand, its prior by closed forms.
#include "certainty/lean.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace palpation {
namespace {

constexpr double kMm = 1e-3;

TEST(Lean, RisesTowardsASideAndFallsTowardsTheOther) {
  const Lean lean(0.4, 0.0, 0.0, 0.0);
  EXPECT_EQ(log_steepness(lean, Vec2::Zero(), 4 * kMm), 0.0);
  EXPECT_NEAR(log_steepness(lean, kMm * Vec2(4, 0), 4 * kMm), 0.4 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(log_steepness(lean, Vec2(-1, 0), 4 * kMm), -0.4, 1e-4);
  EXPECT_NEAR(log_steepness(lean, Vec2(0, 1), 4 * kMm), 0.0, 1e-12);
}

TEST(Lean, RisesTowardsTwoOppositeSidesAsMuchAsItFallsBetween) {
  const Lean lean(0.0, 0.0, 0.3, 0.1);
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_NEAR(log_steepness(lean, sign * Vec2(1, 0), 4 * kMm), 0.3, 1e-4);
    EXPECT_NEAR(log_steepness(lean, sign * Vec2(0, 1), 4 * kMm), -0.3, 1e-4);
    EXPECT_NEAR(log_steepness(lean, sign * Vec2(1, 1), 4 * kMm), 0.1, 1e-4);
    EXPECT_NEAR(log_steepness(lean, sign * Vec2(1, -1), 4 * kMm), -0.1, 1e-4);
  }
}

// In scaled numbers (1 + q / 2)^-3 over 2 pi^2, Student's in four dimensions.
TEST(Lean, HasTheDensityOfStudentsLaw) {
  const double scales = std::pow(0.25 * 0.125, 2), middle = 2.0 * std::pow(std::numbers::pi, 2);
  EXPECT_NEAR(log_density(Lean::Zero()), -std::log(middle * scales), 1e-12);
  EXPECT_NEAR(log_density(Lean(0.25, 0.5, 0.125, -0.25)),
              -std::log(middle * scales * std::pow(1.0 + 10.0 / 2.0, 3)), 1e-12);
}

// Of two of the numbers, in scales, 1 / (1 + r^2 / 2) lie beyond r; of all four within r a square,
// that of the rest.
TEST(Lean, IsDrawnAsTheLawHasIt) {
  Random random(5);
  constexpr int kDraws = 20000;
  for (const double far : {0.7, 1.4, 5.0}) {
    const double beyond = 1.0 / (1.0 + 0.5 * far * far);
    double once = 0.0, twice = 0.0, all = 0.0;
    for (int i = 0; i < kDraws; ++i) {
      const Lean lean = draw_lean(random);
      const double of_once = lean.head<2>().norm() / 0.25, of_twice = lean.tail<2>().norm() / 0.125;
      once += of_once > far ? 1.0 / kDraws : 0.0;
      twice += of_twice > far ? 1.0 / kDraws : 0.0;
      all += std::hypot(of_once, of_twice) < far ? 1.0 / kDraws : 0.0;
    }
    EXPECT_NEAR(once, beyond, 0.015);
    EXPECT_NEAR(twice, beyond, 0.015);
    EXPECT_NEAR(all, (1.0 - beyond) * (1.0 - beyond), 0.015);
  }
}

}  // namespace
}  // namespace palpation
