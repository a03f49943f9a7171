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
  EXPECT_FALSE(found->may_be_tissue);
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

// Most of the readings are alike, or some at both ends: without noise a plateau is, too.
TEST(Saturation, MayBeTissueThatReadsTheSameWithoutNoise) {
  std::vector<double> readings(30, 7.0);
  for (int i = 0; i < 20; ++i) readings.push_back(7.5 + 0.1 * i);
  const auto floor = saturation_of(readings);
  ASSERT_TRUE(floor);
  EXPECT_FALSE(floor->is_upper);
  EXPECT_TRUE(floor->may_be_tissue);
  std::vector<double> plateaus = noisy_readings(60);
  for (double& reading : plateaus) reading = std::clamp(reading, 7.0, 9.0);
  const auto both = saturation_of(plateaus);
  ASSERT_TRUE(both);
  EXPECT_TRUE(both->may_be_tissue);
  EXPECT_FALSE(saturation_of(std::vector{7.0, 7.0, 7.0, 7.0, 9.0, 9.0, 9.0}));
}

TEST(Saturation, IsNoFaultFarFromAllOthers) {
  std::vector<double> readings = noisy_readings(60);
  const auto [least, greatest] = std::ranges::minmax(readings);
  readings.insert(readings.end(), 4, greatest + 1.9 * (greatest - least));
  EXPECT_TRUE(saturation_of(readings));
  for (int i = 0; i < 4; ++i) readings.pop_back();
  readings.insert(readings.end(), 4, greatest + 2.1 * (greatest - least));
  EXPECT_FALSE(saturation_of(readings));
}

Palpation palpation_of(double reading, int session = 0) {
  Palpation palpation;
  palpation.reading = reading;
  palpation.session = session;
  return palpation;
}

// What ends in one session lies amid another's, where gains or zeros differ.
TEST(Saturation, OfASessionIsItsOwn) {
  std::vector<Palpation> palpations;
  for (const double reading : noisy_readings(60)) palpations.push_back(palpation_of(reading));
  for (const double reading : noisy_readings(60))
    palpations.push_back(palpation_of(std::min(reading - 1.0, 8.0), 1));
  const std::vector<Saturation> found = saturations_of(palpations);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found.front().session, 1);
  EXPECT_EQ(found.front().value, 8.0);
  EXPECT_TRUE(found.front().ends(palpation_of(8.0, 1)));
  EXPECT_FALSE(found.front().ends(palpation_of(8.0)));
  for (Palpation& one : palpations) one.session = 0;
  EXPECT_TRUE(saturations_of(palpations).empty());
  for (std::size_t i = 0; i < palpations.size(); ++i) {
    palpations[i].session = static_cast<int>(i % 2);
    palpations[i].reading = std::min(palpations[i].reading, 7.9);
  }
  const std::vector<Saturation> common = saturations_of(palpations);
  ASSERT_EQ(common.size(), 1u);
  EXPECT_FALSE(common.front().session);
  EXPECT_TRUE(common.front().ends(palpation_of(7.9, 1)));
}

// One session ends below, the other above: of all together that is as well healthy tissue and a
// tumour without noise, of either it is not.
TEST(Saturation, OfASessionMayBeWhereThatOfAllMayBeTissue) {
  std::vector<Palpation> palpations;
  for (const double reading : noisy_readings(60)) {
    if (reading < 9.0) palpations.push_back(palpation_of(std::max(reading, 7.0)));
    if (reading > 7.0) palpations.push_back(palpation_of(std::min(reading, 9.0), 1));
  }
  const std::vector<Saturation> found = saturations_of(palpations);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_TRUE(found[0].may_be_tissue);
  EXPECT_TRUE(found[1].ends(palpation_of(7.0, 0)));
  EXPECT_TRUE(found[2].ends(palpation_of(9.0, 1)));
}

}  // namespace
}  // namespace palpation
