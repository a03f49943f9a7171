#include "exploration/session_units.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "palpation/base/random.h"
#include "palpation/exploration/conclusion.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

constexpr double kRadius_m = 0.006;

Surface tissue() {
  Random random(0);
  return Surface(make_plane({.size_m = {0.025, 0.025}, .columns = 51, .rows = 51}, random));
}

/// 7 and 9 in the first session, each of `readings` long; `gain` times as much and 5 more in the
/// second.
std::vector<Palpation> felt_in_two(const Surface& surface, double gain, std::uint64_t seed,
                                   int readings = 70, double contrast = 2.0) {
  Random random(seed);
  std::vector<Palpation> palpations;
  for (int i = 0; i < 2 * readings; ++i) {
    const auto vertex = static_cast<int>(random.uniform() * surface.vertex_count());
    const double depth_m = kRadius_m - (surface.vertex(vertex) - Vec3(0.0105, 0.0125, 0.0)).norm();
    const double reading =
        7.0 + contrast / (1.0 + std::exp(-1400.0 * depth_m)) + 0.1 * random.normal();
    const int session = i / readings;
    palpations.push_back({.where = surface.at_vertex(vertex),
                          .reading = session == 0 ? reading : 5.0 + gain * reading,
                          .session = session});
  }
  return palpations;
}

TEST(SessionUnits, AreSeenWhereOneIsInAnother) {
  const Surface surface = tissue();
  for (const double gain : {1000.0, 12.0, 0.05, 1e-6}) {
    const std::vector<Misfit> units = session_units(surface, felt_in_two(surface, gain, 1));
    ASSERT_EQ(units.size(), 1u) << gain;
    EXPECT_EQ(units[0].session, 1);
    EXPECT_EQ(units[0].number, 70u);
    EXPECT_NEAR((1.0 + units[0].amount) / gain, 1.0, 0.35);
  }
}

TEST(SessionUnits, AreOneWhereGainsAreAlikeOrNothingTellsThem) {
  const Surface surface = tissue();
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    EXPECT_TRUE(session_units(surface, felt_in_two(surface, 1.0, seed)).empty());
    EXPECT_TRUE(session_units(surface, felt_in_two(surface, 10.0, seed, 70, 0.0)).empty());
    EXPECT_TRUE(session_units(surface, felt_in_two(surface, 10.0, seed, 15)).empty());
  }
}

TEST(SessionUnits, AreDrawnWithTheOutlines) {
  const Surface surface = tissue();
  const Conclusion all = conclude(surface, {.level = {.estimate = LevelEstimate::Edge}},
                                  felt_in_two(surface, 1000.0, 2), nullptr, 1);
  const std::vector<SessionChange> sessions = session_changes(all);
  ASSERT_EQ(sessions.size(), 1u);
  ASSERT_TRUE(sessions[0].gain && all.outlines);
  EXPECT_LT(sessions[0].gain->least, 1000.0);
  EXPECT_GT(sessions[0].gain->most, 1000.0);
  EXPECT_LT(sessions[0].gain->most, 1.3 * sessions[0].gain->least);
  const double area_m2 = std::numbers::pi * kRadius_m * kRadius_m;
  EXPECT_LT(all.outlines->area_m2.least, area_m2);
  EXPECT_GT(all.outlines->area_m2.most, area_m2);
}

}  // namespace
}  // namespace palpation
