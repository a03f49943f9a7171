// Faults among readings that nobody asked to be screened: they neither hide a tumour nor make one.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "palpation/base/random.h"
#include "palpation/boundary/level_set.h"
#include "palpation/exploration/exploration.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/readings/screening.h"
#include "palpation/world/phantom.h"

namespace palpation {
namespace {

constexpr double kRadius_m = 0.005;
constexpr double kTumour_m2 = std::numbers::pi * kRadius_m * kRadius_m;

Surface sheet() {
  Random random(1);
  return Surface(make_plane({.size_m = {0.02, 0.03}, .columns = 41, .rows = 61}, random));
}

/// As a run over a disk made them, without any fault.
std::vector<Palpation> felt_on(const Surface& tissue, double noise, std::uint64_t seed) {
  const Phantom phantom(tissue, {Disk{.centre_m = {0.011, 0.017, 0.0}, .radius_m = kRadius_m}},
                        {.noise = noise});
  Random random(seed);
  Exploration run(tissue, {}, {.batches = 6});
  std::vector<Palpation> all;
  for (std::vector<int> stops = run.next(); !stops.empty(); stops = run.next()) {
    std::vector<Palpation> batch;
    for (const int stop : stops) {
      batch.push_back(phantom.touch(tissue.at_vertex(stop), random));
      batch.back().batch = run.batch();
    }
    run.record(batch);
    all.insert(all.end(), batch.begin(), batch.end());
  }
  return all;
}

double area_found(const Surface& tissue, const std::vector<Palpation>& readings) {
  const Conclusion conclusion = conclude(tissue, {}, readings);
  return conclusion.contour
             ? superlevel_area(tissue, conclusion.contour->field, conclusion.contour->level)
             : 0.0;
}

int set_aside_of(const Surface& tissue, const std::vector<Palpation>& readings) {
  const Conclusion conclusion = conclude(tissue, {}, readings);
  return static_cast<int>(std::ranges::count_if(
      conclusion.palpations, [](const Palpation& one) { return !one.set_aside.empty(); }));
}

TEST(FaultyReadings, NoneIsSetAsideWhereAllAreSound) {
  const Surface tissue = sheet();
  for (const double noise : {0.01, 0.1, 0.25}) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed)
      EXPECT_EQ(set_aside_of(tissue, felt_on(tissue, noise, seed)), 0) << noise << " " << seed;
  }
}

TEST(FaultyReadings, LostContactsHideNoTumour) {
  const Surface tissue = sheet();
  for (const int lost : {2, 12}) {
    std::vector<Palpation> readings = felt_on(tissue, 0.05, 3);
    Random random(7);
    for (int i = 0; i < lost; ++i)
      readings[static_cast<std::size_t>(random.below(static_cast<int>(readings.size())))].reading =
          0.0;
    EXPECT_NEAR(area_found(tissue, readings), kTumour_m2, 0.15 * kTumour_m2) << lost;
  }
}

// The second would hide behind the first.
TEST(FaultyReadings, WildOnesHideNoTumourHoweverManyTimesTheRange) {
  const Surface tissue = sheet();
  for (const double wild : {-30.0, 25.0, 200.0}) {
    std::vector<Palpation> readings = felt_on(tissue, 0.05, 4);
    readings[20].reading = wild;
    readings[44].reading = 3.0 * wild;
    EXPECT_NEAR(area_found(tissue, readings), kTumour_m2, 0.15 * kTumour_m2) << wild;
  }
}

// A step between neighbours, without noise.
TEST(FaultyReadings, TheSteepestEdgeIsNone) {
  const Surface tissue = sheet();
  std::vector<Palpation> readings = felt_on(tissue, 0.0, 5);
  for (Palpation& one : readings)
    one.reading = (tissue.position(one.where) - Vec3(0.011, 0.017, 0.0)).norm() < kRadius_m;
  EXPECT_EQ(set_aside_of(tissue, readings), 0);
}

}  // namespace
}  // namespace palpation
