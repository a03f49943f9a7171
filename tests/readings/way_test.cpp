#include "readings/way.h"

#include <gtest/gtest.h>

#include "readings/readings.h"
#include "readings/tissue.h"

namespace palpation {
namespace {

Palpation on_the_way(const Surface& tissue, const Vec3& place, const Vec3& travel, double reading) {
  Palpation palpation;
  palpation.where = tissue.project(place);
  palpation.kind = TouchKind::Way;
  palpation.travel = travel;
  palpation.reading = reading;
  return palpation;
}

TEST(MergedOnTheWay, PutsNeighboursInTheirMiddleWithTheirPrecisionsAddedUp) {
  const Surface tissue = plane(26, 51);
  std::vector<Palpation> palpations;
  for (int i = 0; i < 5; ++i)
    palpations.push_back(
        on_the_way(tissue, {0.010 + 0.001 * i, 0.02, 0.0}, Vec3::UnitX(), 7.0 + 0.1 * i));
  palpations[3].noise_variance = 0.02;
  palpations.push_back(touch(tissue, 400, 8.0));  // a stop stays
  palpations.push_back(
      on_the_way(tissue, {0.0146, 0.02, 0.0}, Vec3::UnitX(), 1.0));  // so does what comes after it
  palpations.push_back(
      on_the_way(tissue, {0.0146, 0.0205, 0.0}, Vec3::UnitY(), 2.0));  // and what goes another way
  const std::vector<Palpation> merged = merged_on_the_way(tissue, palpations, 0.00105, 0.01);
  ASSERT_EQ(merged.size(), 6u);
  EXPECT_NEAR(merged[0].reading, 7.05, 1e-12);
  EXPECT_NEAR(merged[0].noise_variance, 0.005, 1e-12);
  EXPECT_NEAR(tissue.position(merged[0].where).x(), 0.0105, 1e-12);
  EXPECT_NEAR(merged[1].reading, (7.2 / 0.01 + 7.3 / 0.02) / 150.0,
              1e-12);  // twice the noise counts half
  EXPECT_NEAR(tissue.position(merged[1].where).x(), 0.012 + 0.001 / 3.0, 1e-12);
  EXPECT_EQ(merged[2].reading, 7.4);
  EXPECT_EQ(merged[3].reading, 8.0);
  EXPECT_EQ(merged[4].reading, 1.0);
  EXPECT_EQ(merged[5].reading, 2.0);
  std::vector<std::size_t> numbers;
  for (const Palpation& one : merged) numbers.push_back(one.number.value());
  EXPECT_EQ(numbers, (std::vector<std::size_t>{0, 2, 4, 5, 6, 7}));
}

// 10 and "10 or more" are no mean.
TEST(MergedOnTheWay, LeavesTheEndOfARangeApart) {
  const Surface tissue = plane(26, 51);
  std::vector<Palpation> two(2, on_the_way(tissue, {0.010, 0.02, 0.0}, Vec3::UnitX(), 10.0));
  EXPECT_EQ(merged_on_the_way(tissue, two, 0.00105, 0.01).size(), 1u);
  two.back().bound = Bound::AtLeast;
  EXPECT_EQ(merged_on_the_way(tissue, two, 0.00105, 0.01).size(), 2u);
}

// Their mean is not what lies in the middle.
TEST(MergedOnTheWay, LeavesReadingsApartThatDifferByMoreThanNoise) {
  const Surface tissue = plane(26, 51);
  const auto pair = [&](double rise) {
    return std::vector<Palpation>{
        on_the_way(tissue, {0.010, 0.02, 0.0}, Vec3::UnitX(), 7.0),
        on_the_way(tissue, {0.011, 0.02, 0.0}, Vec3::UnitX(), 7.0 + rise)};
  };
  EXPECT_EQ(merged_on_the_way(tissue, pair(-0.28), 0.00105, 0.01).size(), 1u);
  EXPECT_EQ(merged_on_the_way(tissue, pair(-0.29), 0.00105, 0.01).size(), 2u);
}

TEST(MergedOnTheWay, LeavesReadingsWithoutNoiseApart) {
  const Surface tissue = plane(26, 51);
  const std::vector<Palpation> two{on_the_way(tissue, {0.010, 0.02, 0.0}, Vec3::UnitX(), 7.0),
                                   on_the_way(tissue, {0.011, 0.02, 0.0}, Vec3::UnitX(), 8.0)};
  EXPECT_EQ(merged_on_the_way(tissue, two, 0.00105, 0.0).size(), 2u);
}

}  // namespace
}  // namespace palpation
