// What speaks for a second height, by numbers that are known.
#include "certainty/outline_core_odds.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpation {
namespace {

/// Of an outline whose area varies by a square millimetre.
SettledOutline settled_at(double log_odds, double area_mm2, double has_plateau = 0.9) {
  return {.log_odds = log_odds,
          .has_plateau = has_plateau,
          .area_m2 = area_mm2 * 1e-6,
          .area_sd_m2 = 1e-6};
}

// Chance, 2 %, is 3.9 nats; a thousand to one are 6.9.
TEST(OutlineCoreOdds, OfLessThanAThousandToOneTellNeitherWhereTheTwoEndElsewhere) {
  const SettledOutline one = settled_at(100.0, 80.0);
  EXPECT_EQ(heights_by(one, settled_at(94.0, 120.0)), Heights::OneOrTwo);
  EXPECT_EQ(heights_by(one, settled_at(97.0, 81.0)), Heights::One);
  EXPECT_EQ(heights_by(one, settled_at(92.0, 120.0)), Heights::One);
  EXPECT_EQ(heights_by(one, settled_at(105.0, 81.0)), Heights::OneOrTwo);
}

TEST(OutlineCoreOdds, ReadingsThatOneHeightHasOnItsPlateauSpeakForNoCore) {
  SettledOutline one = settled_at(100.0, 80.0), two = settled_at(102.0, 120.0);
  one.readings = {{.on_plateau = 1.0}, {.on_plateau = 0.0}, {.on_plateau = 0.5}};
  two.readings = {{.on_plateau = 1.0, .alike = 40.0},
                  {.on_plateau = 1.0, .alike = 3.0},
                  {.on_plateau = 1.0, .alike = 4.0}};
  EXPECT_DOUBLE_EQ(alike(one, two), 5.0);
  EXPECT_EQ(heights_by(one, two), Heights::Two);
  two.level = 0.2;
  EXPECT_EQ(heights_by(one, two), Heights::OneOrTwo);
  one.readings[1].on_plateau = 1.0;
  EXPECT_EQ(heights_by(one, two), Heights::OneOrTwo);
}

// A thousand to one, twice over, are 13.8 nats.
TEST(OutlineCoreOdds, OfAMillionToOneAreForACoreWhateverReadsAlikeWhereOneHeightHasAPlateau) {
  const SettledOutline one = settled_at(100.0, 80.0);
  EXPECT_EQ(heights_by(one, settled_at(113.0, 120.0)), Heights::OneOrTwo);
  EXPECT_EQ(heights_by(one, settled_at(115.0, 120.0)), Heights::Two);
  EXPECT_EQ(heights_by(settled_at(100.0, 80.0, 0.1), settled_at(115.0, 120.0)), Heights::OneOrTwo);
}

// Half of the time where a sixth was probable beforehand: one height is three times as probable.
TEST(OutlineCoreOdds, OfACoreThatIsOftenLevelAreNoMoreThanThatTells) {
  const SettledOutline one = settled_at(100.0, 80.0);
  SettledOutline two = settled_at(110.0, 81.0);
  two.level_beforehand = 1.0 / 6.0;
  EXPECT_EQ(heights_by(one, two), Heights::OneOrTwo);
  two.level = 0.5;
  EXPECT_EQ(heights_by(one, two), Heights::One);
  two.area_m2 = 120e-6;
  EXPECT_EQ(heights_by(one, two), Heights::OneOrTwo);
}

// Odds that are known to 3.5 nats: the mean of a sigmoid over a normal law, by quadrature.
TEST(OutlineCoreOdds, TellHowProbableTwoHeightsAreAsFarAsTheyAreKnown) {
  const SettledOutline one = settled_at(100.0, 80.0);
  const double sd = 0.5 * std::log(1000.0);
  for (const double gained : {0.0, -3.0, -6.9, -12.0}) {
    double mean = 0.0, total = 0.0;
    for (double z = -6.0; z <= 6.0; z += 0.01) {
      const double density = std::exp(-0.5 * z * z);
      mean += density / (1.0 + std::exp(-gained - sd * z));
      total += density;
    }
    EXPECT_NEAR(probability_of_two(one, settled_at(100.0 + gained, 120.0)), mean / total, 0.02);
  }
  EXPECT_EQ(probability_of_two(one, settled_at(104.0, 120.0)), 0.5);
}

}  // namespace
}  // namespace palpation
