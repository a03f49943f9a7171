#include "palpation/world/sensor.h"

#include <gtest/gtest.h>

#include <limits>

#include "palpation/base/error.h"
#include "world/tissue.h"

namespace palpation {
namespace {

constexpr int kReadings = 2000;

// Of 2,000 readings a tenth is 200 +- 13: four times that is allowed.
TEST(FaultySensor, LosesContactAsOftenAsItIsTold) {
  FaultySensor sensor({.lost = 0.1}, {}, 7.0, 9.0);
  Random random(1);
  int lost = 0;
  for (int i = 0; i < kReadings; ++i) {
    const double told = sensor.reported(8.0, random);
    EXPECT_TRUE(told == 0.0 || told == 8.0);
    lost += told == 0.0;
  }
  EXPECT_NEAR(lost, 200, 54);
}

TEST(FaultySensor, IsWildWithinItsRanges) {
  FaultySensor sensor({.wild = 1.0, .wild_ranges = 3.0}, {}, 7.0, 9.0);
  Random random(2);
  double least = 8.0, most = 8.0;
  for (int i = 0; i < kReadings; ++i) {
    const double told = sensor.reported(7.0, random);
    least = std::min(least, told);
    most = std::max(most, told);
  }
  EXPECT_GE(least, 2.0);
  EXPECT_LE(most, 14.0);
  EXPECT_GT(most - least, 11.0);
}

TEST(FaultySensor, RepeatsTheReadingBeforeWhereItJams) {
  FaultySensor sensor({.jammed = 1.0}, {}, 7.0, 9.0);
  Random random(3);
  EXPECT_EQ(sensor.reported(8.5, random), 7.0);  // before the first: healthy tissue
  EXPECT_EQ(sensor.reported(8.9, random), 7.0);
}

// A fifth of the range in a hundred readings: .2 * 2 / 100 each.
TEST(FaultySensor, DriftsReadingByReading) {
  FaultySensor sensor({.drift = 0.2}, {}, 7.0, 9.0);
  Random random(4);
  for (int i = 0; i < 10; ++i) EXPECT_NEAR(sensor.reported(7.0, random), 7.0 + 0.004 * i, 1e-12);
}

TEST(FaultySensor, ChangesOnceAndForAll) {
  FaultySensor sensor({}, {.after_stops = 2, .zero = 0.5, .gain = 2.0}, 7.0, 9.0);
  Random random(5);
  EXPECT_EQ(sensor.reported(8.0, random), 8.0);
  EXPECT_EQ(sensor.reported(8.0, random), 8.0);
  EXPECT_EQ(sensor.reported(8.0, random), 7.0 + 2.0 * 1.0 + 0.5 * 2.0);
}

TEST(FaultySensor, ChangesAfterStopsWhateverIsFeltOnTheWay) {
  FaultySensor sensor({}, {.after_stops = 1, .zero = 0.5}, 7.0, 9.0);
  Random random(5);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(sensor.reported(8.0, random, TouchKind::Way), 8.0);
  EXPECT_EQ(sensor.reported(8.0, random, TouchKind::Stop), 8.0);
  EXPECT_EQ(sensor.reported(8.0, random, TouchKind::Way), 9.0);
}

TEST(FaultySensor, FeelsWhereTheTissueWentOnceItMoved) {
  const Surface surface = sheet(0.024, 0.048, 0.001);
  FaultySensor sensor({}, {.after_stops = 1, .moved_m = Vec3(0.003, 0.0, 0.0)}, 7.0, 9.0);
  const SurfacePoint where = surface.at_vertex(surface.nearest_vertex(Vec3(0.012, 0.024, 0.0)));
  EXPECT_EQ(surface.position(sensor.feels_at(surface, where)), surface.position(where));
  Random random(6);
  sensor.reported(7.0, random);
  EXPECT_NEAR((surface.position(sensor.feels_at(surface, where)) - Vec3(0.015, 0.024, 0.0)).norm(),
              0.0, 1e-12);
}

TEST(FaultySensor, FeelsTissueThatBreathesWithEveryReading) {
  const Surface surface = sheet(0.024, 0.048, 0.001);
  FaultySensor sensor({.breath = {.by_m = Vec3(0.0, 0.002, 0.0), .readings = 4.0}}, {}, 7.0, 9.0);
  const SurfacePoint where = surface.at_vertex(surface.nearest_vertex(Vec3(0.012, 0.024, 0.0)));
  Random random(8);
  for (const double off_m : {0.0, 0.002, 0.0, -0.002, 0.0}) {
    EXPECT_NEAR(
        (surface.position(sensor.feels_at(surface, where)) - Vec3(0.012, 0.024 + off_m, 0.0))
            .norm(),
        0.0, 1e-12);
    sensor.reported(7.0, random, TouchKind::Way);
  }
}

TEST(FaultySensor, RefusesPartsThatAreNone) {
  EXPECT_THROW(FaultySensor({.breath = {.readings = 0.0}}, {}, 7.0, 9.0), InvalidInput);
  EXPECT_THROW(
      FaultySensor({.breath = {.phase = std::numeric_limits<double>::quiet_NaN()}}, {}, 7.0, 9.0),
      InvalidInput);
  EXPECT_THROW(FaultySensor({.lost = 1.5}, {}, 7.0, 9.0), InvalidInput);
  EXPECT_THROW(FaultySensor({}, {.gain = std::numeric_limits<double>::infinity()}, 7.0, 9.0),
               InvalidInput);
  EXPECT_THROW(FaultySensor({}, {}, 9.0, 9.0), InvalidInput);
}

}  // namespace
}  // namespace palpation
