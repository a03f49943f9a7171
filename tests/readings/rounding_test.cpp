#include "readings/rounding.h"

#include <gtest/gtest.h>

#include <cmath>

#include "readings/tissue.h"

namespace palpation {
namespace {

std::vector<Palpation> readings_in_steps(const Surface& tissue, double step) {
  Random random(3);
  std::vector<Palpation> readings;
  for (int i = 0; i < 120; ++i) {
    const double reading = 7.0 + (i % 5 == 0 ? 2.0 : 0.0) + 0.1 * random.normal();
    readings.push_back(
        touch(tissue, 11 * i, step > 0.0 ? step * std::round(reading / step) : reading));
  }
  return readings;
}

TEST(RoundingVariance, IsATwelfthOfTheStepSquared) {
  EXPECT_NEAR(rounding_variance(readings_in_steps(plane(41, 41), 0.5)), 0.25 / 12.0, 1e-12);
}

TEST(RoundingVariance, IsNoneOfReadingsThatHardlyRepeat) {
  EXPECT_EQ(rounding_variance(readings_in_steps(plane(41, 41), 0.0)), 0.0);
}

TEST(RoundingVariance, IsNoneOfReadingsThatAreAllAlike) {
  std::vector<Palpation> alike = readings_in_steps(plane(41, 41), 0.0);
  for (Palpation& palpation : alike) palpation.reading = 7.0;
  EXPECT_EQ(rounding_variance(alike), 0.0);
}

TEST(RoundingVariance, IsNoneOfTwoPlateausWithoutNoise) {
  std::vector<Palpation> stepped = readings_in_steps(plane(41, 41), 0.0);
  for (std::size_t i = 0; i < stepped.size(); ++i) stepped[i].reading = i % 5 == 0 ? 9.0 : 7.0;
  EXPECT_EQ(rounding_variance(stepped), 0.0);
}

}  // namespace
}  // namespace palpation
