// Stops that are merged tell what they told one by one.
#include "readings/dense_stops.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "readings/tissue.h"

namespace palpation {
namespace {

constexpr double kNoiseVariance = 0.04, kWithin_m = 0.001;

std::vector<Palpation> stops_over(const Surface& surface, int count) {
  Random random(3);
  std::vector<Palpation> stops;
  for (int i = 0; i < count; ++i) {
    const Vec3 place(0.025 * random.uniform(), 0.050 * random.uniform(), 0.0);
    stops.push_back({.where = surface.project(place),
                     .reading = (place.x() < 0.0125 ? 7.0 : 9.0) + 0.2 * random.normal()});
  }
  return stops;
}

TEST(MergedInCells, KeepPrecisionsAndTheirMean) {
  const Surface surface = plane(26, 51);
  std::vector<Palpation> stops = stops_over(surface, 4000);
  stops[7].noise_variance = 0.01;
  const std::vector<Palpation> merged = merged_in_cells(surface, stops, kWithin_m, kNoiseVariance);
  EXPECT_LT(merged.size(), 2500u);
  double precision = 0.0, weighed = 0.0, told = 0.0;
  for (const Palpation& one : merged) {
    const double own = std::isnan(one.noise_variance) ? kNoiseVariance : one.noise_variance;
    precision += 1.0 / own;
    weighed += one.reading / own;
  }
  for (std::size_t i = 0; i < stops.size(); ++i)
    told += stops[i].reading / (i == 7 ? 0.01 : kNoiseVariance);
  EXPECT_NEAR(precision, 3999 / kNoiseVariance + 100.0, 1e-6);
  EXPECT_NEAR(weighed, told, 1e-6);
}

TEST(MergedInCells, KeepApartWhatAnEdgePartsOrWasNotMadeTogether) {
  const Surface surface = plane(26, 51);
  const auto stop = [&](double reading, int batch, int session) {
    return Palpation{.where = surface.project(Vec3(0.0052, 0.0053, 0.0)),
                     .reading = reading,
                     .batch = batch,
                     .session = session};
  };
  std::vector<Palpation> stops = {stop(7.0, 0, 0), stop(9.0, 0, 0), stop(7.1, 1, 0),
                                  stop(7.1, 0, 1), stop(7.2, 0, 0), stop(7.0, 0, 0)};
  stops.back().set_aside = "wild";
  const std::vector<Palpation> merged = merged_in_cells(surface, stops, kWithin_m, kNoiseVariance);
  ASSERT_EQ(merged.size(), 5u);
  EXPECT_NEAR(merged.front().reading, 7.1, 1e-12);
  EXPECT_NEAR(merged.front().noise_variance, 0.5 * kNoiseVariance, 1e-12);
  EXPECT_EQ(merged.back().set_aside, "wild");
}

// 10 and "10 or more" are no mean.
TEST(MergedInCells, KeepTheEndOfARangeApart) {
  const Surface surface = plane(26, 51);
  std::vector<Palpation> stops(
      4, {.where = surface.project(Vec3(0.0052, 0.0053, 0.0)), .reading = 10.0});
  stops[1].bound = stops[3].bound = Bound::AtLeast;
  const std::vector<Palpation> merged = merged_in_cells(surface, stops, kWithin_m, kNoiseVariance);
  ASSERT_EQ(merged.size(), 2u);
  EXPECT_EQ(merged[0].bound, Bound::None);
  EXPECT_EQ(merged[1].bound, Bound::AtLeast);
}

// What one says of a moment is said of the list as it was made: here each place is felt twice, at
// the beginning and at the end.
TEST(MergedInCells, KnowWhenTheFirstOfEachWasMade) {
  const Surface surface = plane(26, 51);
  std::vector<Palpation> stops;
  for (const int column : {0, 1, 2, 2, 1, 0})
    stops.push_back({.where = surface.project(Vec3(0.0052 + 0.003 * column, 0.0053, 0.0)),
                     .reading = 7.0 + column});
  stops.push_back({.where = surface.at_vertex(0), .reading = 5.0});
  const std::vector<Palpation> merged = merged_in_cells(surface, stops, kWithin_m, kNoiseVariance);
  std::vector<std::size_t> numbers;
  for (const Palpation& one : merged) numbers.push_back(one.number.value());
  EXPECT_EQ(numbers, (std::vector<std::size_t>{0, 1, 2, 6}));
}

TEST(MergedInCells, AreTheSameInWhateverOrderTheyWereMade) {
  const Surface surface = plane(26, 51);
  std::vector<Palpation> stops = stops_over(surface, 1000);
  const auto readings_of = [&] {
    std::vector<double> readings;
    for (const Palpation& one : merged_in_cells(surface, stops, kWithin_m, kNoiseVariance))
      readings.push_back(one.reading);
    std::ranges::sort(readings);
    return readings;
  };
  const std::vector<double> before = readings_of();
  std::ranges::reverse(stops);
  EXPECT_EQ(readings_of(), before);
}

}  // namespace
}  // namespace palpation
