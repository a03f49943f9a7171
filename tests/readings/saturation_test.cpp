#include "readings/saturation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "palpation/base/random.h"

namespace palpation {
namespace {

std::vector<double> noisy_readings(int count) {
  Random random(3);
  std::vector<double> readings;
  for (int i = 0; i < count; ++i) readings.push_back(8.0 + random.normal());
  return readings;
}

TEST(Saturation, IsWhereReadingsStopAtOneValue) {
  std::vector<double> readings = noisy_readings(60);
  for (double& reading : readings) reading = std::min(reading, 9.0);
  const auto cut = static_cast<std::size_t>(std::ranges::count(readings, 9.0));
  ASSERT_GE(cut, 3);
  const auto found = saturation_of(readings);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->value, 9.0);
  EXPECT_EQ(found->count, cut);
  EXPECT_TRUE(found->is_upper);
  for (double& reading : readings) reading = -reading;
  const auto below = saturation_of(readings);
  ASSERT_TRUE(below);
  EXPECT_EQ(below->value, -9.0);
  EXPECT_FALSE(below->is_upper);
}

TEST(Saturation, IsNotNoiseNorWhatIsRoundedNorAllAlike) {
  EXPECT_FALSE(saturation_of(noisy_readings(60)));
  std::vector<double> rounded = noisy_readings(60);
  for (double& reading : rounded) reading = std::round(2.0 * reading) / 2.0;
  EXPECT_FALSE(saturation_of(rounded));
  EXPECT_FALSE(saturation_of(std::vector<double>(20, 7.0)));
  EXPECT_FALSE(saturation_of({}));
}

TEST(Saturation, IsNotHealthyTissueThatReadsTheSameWithoutNoise) {
  std::vector<double> readings(30, 7.0);
  for (int i = 0; i < 20; ++i) readings.push_back(7.5 + 0.1 * i);
  EXPECT_FALSE(saturation_of(readings));
}

}  // namespace
}  // namespace palpation
