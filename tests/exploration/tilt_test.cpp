#include "exploration/tilt.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>

#include "palpation/base/random.h"
#include "palpation/exploration/conclusion.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

constexpr double kNoise = 0.1;
constexpr double kRadius_m = 0.005;

Surface tissue() {
  Random random(0);
  return Surface(make_plane({.size_m = {0.025, 0.04}, .columns = 51, .rows = 81}, random));
}

struct Sloping {
  double contrast = 2.0;
  Vec3 middle{0.012, 0.022, 0.0};
  double radius_m = kRadius_m;
  Vec3 slope_per_m = Vec3::Zero();
};

/// Conclusion of readings at random places; of a disk, 7 outside.
Conclusion concluded(const Surface& surface, const Sloping& world, std::uint64_t seed,
                     std::optional<std::uint64_t> sampling_seed = std::nullopt) {
  Random random(seed);
  std::vector<Palpation> palpations;
  for (int i = 0; i < 120; ++i) {
    const int vertex = random.below(surface.vertex_count());
    const Vec3 place = surface.vertex(vertex);
    const double depth_m = world.radius_m - (place - world.middle).norm();
    const double stiff = world.contrast / (1.0 + std::exp(-1400.0 * depth_m));
    palpations.push_back(
        {.where = surface.at_vertex(vertex),
         .reading = 7.0 + stiff + world.slope_per_m.dot(place) + kNoise * random.normal(),
         .batch = i / 15});
  }
  return conclude(surface, {.level = {.estimate = LevelEstimate::Edge}}, palpations, nullptr,
                  sampling_seed);
}

TEST(Tilt, IsTakenBackFromTissueWithATumour) {
  const Surface surface = tissue();
  const double flat_m2 = concluded(surface, {}, 1, 1).outlines->area_m2.mean;
  for (const double steepness : {40.0, 100.0}) {
    const Sloping world{.slope_per_m = steepness * Vec3(0.6, 0.8, 0.0)};
    const Conclusion conclusion = concluded(surface, world, 1, 1);
    ASSERT_EQ(conclusion.evidence.taken_back.size(), 1u) << steepness;
    const Misfit& tilt = conclusion.evidence.taken_back.front();
    EXPECT_EQ(tilt.kind, MisfitKind::Tilted);
    EXPECT_LT((tilt.background.slope_per_m - world.slope_per_m).norm(), 15.0) << steepness;
    ASSERT_TRUE(conclusion.outlines);
    EXPECT_NEAR(conclusion.outlines->area_m2.mean, flat_m2, 0.06 * flat_m2) << steepness;
  }
}

TEST(Tilt, OfHealthyTissueIsNoTumour) {
  const Surface surface = tissue();
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Conclusion conclusion =
        concluded(surface, {.contrast = 0.0, .slope_per_m = Vec3(0.0, 60.0, 0.0)}, seed);
    EXPECT_FALSE(conclusion.level) << seed;
    ASSERT_EQ(conclusion.evidence.taken_back.size(), 1u) << seed;
    EXPECT_EQ(conclusion.evidence.taken_back.front().kind, MisfitKind::Tilted);
  }
}

/// Along the slope or against it, the tissue's half that is stiff is a step.
TEST(Tilt, IsToldFromTissueThatIsStiffOnOneSide) {
  const Surface surface = tissue();
  const double truth_m2 = 0.5 * 0.025 * 0.04;
  for (const double steepness : {-100.0, 40.0, 100.0}) {
    const Sloping world{.middle = {0.0125, 1.02, 0.0},
                        .radius_m = 1.0,
                        .slope_per_m = steepness * Vec3(0.0, 1.0, 0.0)};
    const Conclusion conclusion = concluded(surface, world, 1, 1);
    ASSERT_EQ(conclusion.evidence.taken_back.size(), 1u) << steepness;
    EXPECT_LT(
        (conclusion.evidence.taken_back.front().background.slope_per_m - world.slope_per_m).norm(),
        15.0)
        << steepness;
    ASSERT_TRUE(conclusion.outlines) << steepness;
    EXPECT_NEAR(conclusion.outlines->area_m2.mean, truth_m2, 0.05 * truth_m2) << steepness;
  }
}

TEST(Tilt, IsAllWhereReadingsLieOnAPlane) {
  const Surface surface = tissue();
  const Vec3 slope_per_m(10.0, 0.0, 0.0);
  std::vector<Palpation> palpations;
  for (int i = 0; i < 16; ++i) {
    const Vec3 place(0.002 + 0.001 * (i % 4), 0.002 + 0.001 * (i / 4), 0.0);
    palpations.push_back(
        {.where = surface.project(place), .reading = 7.0 + slope_per_m.dot(place)});
  }
  const Conclusion conclusion =
      conclude(surface, {.level = {.estimate = LevelEstimate::Edge}}, palpations);
  EXPECT_FALSE(conclusion.level);
  ASSERT_EQ(conclusion.evidence.taken_back.size(), 1u);
  EXPECT_LT((conclusion.evidence.taken_back.front().background.slope_per_m - slope_per_m).norm(),
            0.01);
}

TEST(Tilt, IsNotATumourOnOneSide) {
  const Surface surface = tissue();
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Conclusion conclusion = concluded(surface, {.middle = {0.021, 0.035, 0.0}}, seed);
    EXPECT_TRUE(conclusion.evidence.taken_back.empty()) << seed;
    EXPECT_TRUE(conclusion.level) << seed;
  }
}

}  // namespace
}  // namespace palpation
