// Readings at the end of the sensor's range, against closed forms and integrals.
#include "certainty/bounded_readings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/normal.h"
#include "certainty/outline_chain.h"

namespace palpation {
namespace {

constexpr double kMm = 1e-3;

double normal_density(double z) {
  return std::exp(-half_square(z)) / std::sqrt(2.0 * std::numbers::pi);
}

// E[z | z > a] is the density at a over the probability beyond (Mills); far out, nearly a + 1 / a.
TEST(NormalBeyond, HasTheMeanOfATruncatedNormal) {
  Random random(1);
  constexpr int kDraws = 20'000;
  for (const double least : {-6.0, -1.0, 0.0, 2.0, 8.0, 40.0}) {
    double mean = 0.0, lowest = 1e300;
    for (int i = 0; i < kDraws; ++i) {
      const double drawn = normal_beyond(least, random);
      mean += drawn / kDraws;
      lowest = std::min(lowest, drawn);
    }
    EXPECT_GE(lowest, least);
    const double expected =
        least > 30.0 ? least + 1.0 / least : normal_density(least) / normal_probability(-least);
    EXPECT_NEAR(mean, expected, 4.0 / std::sqrt(kDraws)) << least;
  }
}

TEST(BoundedReadings, AreOffByWhatWasToldOrMoreOnTheirSide) {
  const ToldAtEnd least{Bound::AtLeast, 0.3}, most{Bound::AtMost, 0.3};
  EXPECT_TRUE(least.allows(0.4));
  EXPECT_FALSE(least.allows(0.2));
  EXPECT_TRUE(most.allows(0.2));
  EXPECT_FALSE(most.allows(0.4));
  EXPECT_NEAR(least.probability(0.1, 0.1), normal_probability(-2.0), 1e-12);
  EXPECT_NEAR(most.probability(0.1, 0.1), normal_probability(2.0), 1e-12);
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    EXPECT_GE(least.drawn(0.1, 0.1, random), 0.3);
    EXPECT_LE(most.drawn(0.1, 0.1, random), 0.3);
  }
}

/// A square of 2 mm, far from which all readings are of the low plateau.
struct FarOff {
  OutlineNodes outline;
  OutlineReadings readings;
  OutlinePrior prior;
};

FarOff far_off() {
  FarOff far;
  std::vector<Vec2> square;
  for (const auto& [x, y] :
       {std::pair(0, 0), {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}})
    square.push_back(kMm * Vec2(x, y));
  far.outline.add(square, 0);
  OutlineProfile& median = far.prior.median;
  median.low = 7.0;
  median.high = 9.0;
  median.log_slope = std::log(1200.0);
  median.turns.log_half_width = std::log(0.12);
  median.log_spacing = {std::log(kMm)};
  median.log_contrast = {0.0};
  far.prior.plateaus = {.low_sd = 0.5, .high_sd = 0.5};
  far.prior.residuals = {.noise_log_sd = 1e-9, .wild_density = 1.0 / 3.0};
  return far;
}

// One reading of 7.3 and four that are at least that, noise 0.2: low has the density of its prior
// and of all five, which is integrated over a grid.
TEST(BoundedReadings, DrawAPlateauFromWhatTheyMakeProbable) {
  FarOff far = far_off();
  for (int i = 0; i < 5; ++i) {
    far.readings.places.push_back(Vec2(0.1 + 0.01 * i, 0.2));
    far.readings.reading.push_back(7.3);
    far.readings.variance.push_back(0.04);
    far.readings.bounds.push_back(i == 0 ? Bound::None : Bound::AtLeast);
  }
  double total = 0.0, mean = 0.0, square = 0.0;
  for (double low = 5.0; low < 9.0; low += 0.001) {
    const double off = (7.3 - low) / 0.2,
                 density = std::exp(-half_square((low - 7.0) / 0.5) - half_square(off)) *
                           std::pow(normal_probability(-off), 4);
    total += density;
    mean += density * low;
    square += density * low * low;
  }
  mean /= total;
  const double sd = std::sqrt(square / total - mean * mean);
  OutlineChain by_steps(far.readings, far.prior, far.outline, far.prior.median),
      whatever(far.readings, far.prior, far.outline, far.prior.median);
  Random random(3);
  constexpr int kDraws = 40'000;
  double drawn[2] = {}, squares[2] = {};
  for (int i = 0; i < kDraws; ++i) {
    OutlineProfile next = by_steps.profile();
    next.low += 0.3 * random.normal();
    by_steps.move_profile(next, false, random);
    by_steps.redraw_residuals(random, true);
    whatever.move_whatever_plateaus(far.outline.place, far.prior.median.log_slope, random, 0.0);
    whatever.redraw_residuals(random, true);
    for (const auto& [which, chain] : {std::pair(0, &by_steps), {1, &whatever}}) {
      drawn[which] += chain->profile().low / kDraws;
      squares[which] += chain->profile().low * chain->profile().low / kDraws;
    }
  }
  for (int which = 0; which < 2; ++which) {
    // Draws are correlated over some twenty: four standard errors.
    EXPECT_NEAR(drawn[which], mean, 4.0 * sd * std::sqrt(20.0 / kDraws));
    EXPECT_NEAR(std::sqrt(squares[which] - drawn[which] * drawn[which]), sd, 0.08 * sd);
  }
}

// Half of the probability of all, were it to tell nothing, is beyond: what lies 50 sd on the wrong
// side tells nothing, and one that may be anything beyond tells.
TEST(BoundedReadings, TellNothingWhereNoNoiseMakesThemPossible) {
  FarOff far = far_off();
  for (int i = 0; i < 40; ++i) {
    far.readings.places.push_back(Vec2(0.1 + 0.01 * i, 0.2));
    far.readings.reading.push_back(i == 0 ? 17.0 : i == 1 ? 6.0 : 7.0);
    far.readings.variance.push_back(0.04);
    far.readings.bounds.push_back(i < 2 ? Bound::AtLeast : Bound::None);
  }
  OutlineChain chain(far.readings, far.prior, far.outline, far.prior.median);
  Random random(4);
  int told[2] = {};
  for (int i = 0; i < 400; ++i) {
    chain.redraw_residuals(random, false);
    for (std::size_t reading = 0; reading < 2; ++reading)
      told[reading] += chain.residuals().tells(reading);
  }
  EXPECT_EQ(told[0], 0);
  EXPECT_GT(told[1], 380);
}

}  // namespace
}  // namespace palpation
