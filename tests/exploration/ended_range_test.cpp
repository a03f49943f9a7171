// A sensor whose range ends below what the tumour would read.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "belief/tissue.h"
#include "palpation/exploration/conclusion.h"
#include "palpation/readings/screening.h"
#include "palpation/world/phantom.h"

namespace palpation {
namespace {

constexpr double kRadius_m = 0.008;

/// Of a disk whose edge rises over 6 mm, the sensor ending at two thirds of the contrast; or, for
/// `is_told` false, saying something else of each of what is beyond.
std::vector<Palpation> felt_until(const Surface& tissue, bool is_told) {
  const Phantom phantom(tissue, {Disk{Vec3(0.0125, 0.026, 0.0), kRadius_m}},
                        {.slope_per_m = 700.0, .noise = 0.02});
  Random random(12);
  std::vector<Palpation> readings;
  const double end = 7.0 + 2.0 * 2.0 / 3.0;
  for (int i = 0; i < 150; ++i) {
    Palpation& reading = readings.emplace_back(phantom.touch(
        tissue.project(Vec3(0.025 * random.uniform(), 0.050 * random.uniform(), 0.0)), random));
    if (reading.reading > end) reading.reading = end + (is_told ? 0.0 : 1e-6 * i);
  }
  return readings;
}

// Half way up to where the sensor ended the disk would be a millimetre too wide.
TEST(EndedRange, LeavesOpenHowMuchATumourReads) {
  const Surface tissue = plane(26, 51);
  const std::vector<Palpation> readings = felt_until(tissue, true);
  const double area_m2 = std::numbers::pi * kRadius_m * kRadius_m;
  const Conclusion conclusion = conclude(tissue, Model{}, readings, nullptr, 1);
  EXPECT_GT(std::ranges::count(conclusion.palpations, Bound::AtLeast, &Palpation::bound), 9);
  ASSERT_TRUE(conclusion.outlines);
  const DrawnNumber& drawn = conclusion.outlines->area_m2;
  EXPECT_LT(drawn.least, area_m2);
  EXPECT_GT(drawn.most, area_m2);
  const Conclusion other = conclude(tissue, Model{}, felt_until(tissue, false), nullptr, 1);
  EXPECT_EQ(std::ranges::count(other.palpations, Bound::None, &Palpation::bound), 150);
  ASSERT_TRUE(other.outlines);
  EXPECT_GT(other.outlines->area_m2.least, area_m2);
}

// Five contacts that were lost read the same, too: that is no plateau without noise.
TEST(EndedRange, IsSeenBesideLostContacts) {
  const Surface tissue = plane(26, 51);
  std::vector<Palpation> readings = felt_until(tissue, true);
  for (const int lost : {10, 40, 70, 100, 130}) readings[lost].reading = 0.0;
  const Conclusion conclusion = conclude(tissue, Model{}, readings);
  EXPECT_GT(std::ranges::count(conclusion.palpations, Bound::AtLeast, &Palpation::bound), 9);
  EXPECT_EQ(std::ranges::count(conclusion.palpations, kNoContact, &Palpation::set_aside), 5);
}

// Its zero lies half the contrast below the other's, and so does the end of its range.
TEST(EndedRange, IsSoughtInEachSession) {
  const Surface tissue = plane(26, 51);
  std::vector<Palpation> readings = felt_until(tissue, false);
  std::vector<Palpation> second = felt_until(tissue, true);
  for (Palpation& reading : second) {
    reading.reading -= 1.0;
    reading.session = 1;
  }
  readings.insert(readings.end(), second.begin(), second.end());
  const Conclusion conclusion = conclude(tissue, Model{}, readings);
  int ended = 0;
  for (const Palpation& one : conclusion.palpations) {
    if (!one.is_bound()) continue;
    EXPECT_EQ(one.session, 1);
    ++ended;
  }
  EXPECT_GT(ended, 9);
}

}  // namespace
}  // namespace palpation
