// Backlash, filters and poses that come late: all readings are of where the probe was a little
// before.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "palpation/base/random.h"
#include "palpation/exploration/conclusion.h"
#include "palpation/geometry/make_plane.h"
#include "readings/way.h"

namespace palpation {
namespace {

constexpr double kNoise = 0.08;  // of a contrast of 2

Surface tissue() {
  Random random(0);
  return Surface(make_plane({.size_m = {0.03, 0.03}, .columns = 61, .rows = 61}, random));
}

double stiffness(const Vec3& place) {
  const double depth_m = 0.008 - (place - Vec3(0.014, 0.016, 0.0)).norm();
  return 7.0 + 2.0 / (1.0 + std::exp(-1400.0 * depth_m));
}

/// Rows 2 mm apart, a place each 1.5 mm.
std::vector<Vec3> raster(bool there_and_back) {
  std::vector<Vec3> places;
  for (int row = 0; row < 15; ++row) {
    for (int i = 0; i < 20; ++i) {
      const int column = there_and_back && row % 2 == 1 ? 19 - i : i;
      places.emplace_back(0.00075 + 0.0015 * column, 0.001 + 0.002 * row, 0.0);
    }
  }
  return places;
}

std::vector<Vec3> at_random(std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> places;
  for (int i = 0; i < 120; ++i)
    places.emplace_back(0.0005 + 0.029 * random.uniform(), 0.0005 + 0.029 * random.uniform(), 0.0);
  return places;
}

/// The probe trails behind where it is said to be, along each leg.
Conclusion concluded(const std::vector<Vec3>& places, double behind_m, std::uint64_t seed,
                     Learnable lag_m = 0.0) {
  Random random(seed);
  const Surface surface = tissue();
  std::vector<Palpation> felt;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3 leg = i == 0 ? Vec3(Vec3::Zero()) : Vec3((places[i] - places[i - 1]).normalized());
    felt.push_back({.where = surface.project(places[i]),
                    .reading = stiffness(places[i] - behind_m * leg) + kNoise * random.normal()});
  }
  Model model{.level = {.estimate = LevelEstimate::Edge}};
  model.field.probe.lag_m = lag_m;
  return conclude(surface, model, felt, nullptr, 1);
}

/// How late readings are taken to come, where that was found; else 0.
double lag_found_m(const Conclusion& conclusion) {
  const std::vector<Misfit>& changes = conclusion.evidence.taken_back;
  const auto late = std::ranges::find(changes, MisfitKind::Late, &Misfit::kind);
  return late == changes.end() ? 0.0 : late->amount;
}

TEST(LateReadings, OfPlayOnARasterThereAndBackAreTakenToWhereTheyBelong) {
  for (const double behind_m : {0.0015, -0.0008}) {
    const Conclusion all = concluded(raster(true), behind_m, 1);
    EXPECT_NEAR(lag_found_m(all), behind_m, 0.0002);
  }
}

TEST(LateReadings, OfTouchesInAnyOrderAreToo) {
  EXPECT_NEAR(lag_found_m(concluded(at_random(1), 0.0012, 1)), 0.0012, 0.0004);
}

TEST(LateReadings, AreSeldomSeenWhereNoneComesLate) {
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    seen += lag_found_m(concluded(raster(true), 0.0, seed)) != 0.0;
    seen += lag_found_m(concluded(at_random(seed), 0.0, seed)) != 0.0;
  }
  EXPECT_EQ(seen, 0);
}

TEST(LateReadings, OfOneDirectionAloneDoNotTellWhereTheyBelong) {
  EXPECT_EQ(lag_found_m(concluded(raster(false), 0.0012, 1)), 0.0);
}

TEST(LateReadings, AreNotSoughtBesideALagThatIsModelled) {
  EXPECT_EQ(lag_found_m(concluded(raster(true), 0.0012, 1, 0.0012)), 0.0);
}

TEST(Travel, IsStraightFromTheReadingBeforeOfTheSameSession) {
  const Surface surface = tissue();
  std::vector<Palpation> felt;
  for (const auto& [x, session] : {std::pair(0.01, 0), {0.02, 0}, {0.02, 0}, {0.01, 1}, {0.012, 1}})
    felt.push_back({.where = surface.project({x, 0.01, 0.0}), .session = session});
  felt.back().travel = Vec3(0.0, 1.0, 0.0);
  const std::vector<Palpation> gone = with_travel(surface, felt);
  EXPECT_TRUE(gone[0].travel.isZero(0.0));
  EXPECT_LT((gone[1].travel - Vec3::UnitX()).norm(), 1e-12);
  EXPECT_TRUE(gone[2].travel.isZero(0.0));  // it stayed
  EXPECT_TRUE(gone[3].travel.isZero(0.0));
  EXPECT_EQ(gone[4].travel, felt[4].travel);  // it is given
}

}  // namespace
}  // namespace palpation
