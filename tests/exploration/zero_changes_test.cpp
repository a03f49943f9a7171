#include "exploration/zero_changes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "palpation/base/random.h"
#include "palpation/exploration/conclusion.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

constexpr double kNoise = 0.1;
constexpr int kReadings = 100;  // in ten batches

Surface tissue() {
  Random random(0);
  return Surface(make_plane({.size_m = {0.025, 0.025}, .columns = 51, .rows = 51}, random));
}

/// Of a disk, 7 outside and 9 inside.
double stiffness(const Vec3& place) {
  const double depth_m = 0.006 - (place - Vec3(0.0105, 0.0125, 0.0)).norm();
  return 7.0 + 2.0 / (1.0 + std::exp(-1400.0 * depth_m));
}

using World = std::function<double(const Vec3& place, int reading)>;

/// Readings at random vertices.
std::vector<Palpation> felt(const Surface& surface, const World& world, std::uint64_t seed) {
  Random random(seed);
  std::vector<Palpation> palpations;
  for (int i = 0; i < kReadings; ++i) {
    const auto vertex = static_cast<int>(random.uniform() * surface.vertex_count());
    palpations.push_back({.where = surface.at_vertex(vertex),
                          .reading = world(surface.vertex(vertex), i) + kNoise * random.normal(),
                          .batch = i / 10});
  }
  return palpations;
}

Conclusion concluded(const World& world, std::uint64_t seed) {
  const Surface surface = tissue();
  return conclude(surface, {.level = {.estimate = LevelEstimate::Edge}},
                  felt(surface, world, seed));
}

double sound(const Vec3& place, int) { return stiffness(place); }

TEST(ZeroChanges, AreSeldomSeenWhereThereIsNone) {
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
    seen += !concluded(sound, seed).evidence.zero_changes.empty();
  EXPECT_LE(seen, 4);  // 2 in 100 at most; more than 4 in one of 200 such tests
}

TEST(ZeroChanges, AreTakenBackAsIfTheZeroHadStayed) {
  const World shifted = [](const Vec3& place, int i) {
    return stiffness(place) + (i >= 43 ? 1.5 : 0.0);
  };
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Conclusion here = concluded(shifted, seed), there = concluded(sound, seed);
    ASSERT_EQ(here.evidence.zero_changes.size(), 1u) << seed;
    const ZeroChange& change = here.evidence.zero_changes.front();
    EXPECT_NEAR(change.amount, 1.5, 4.0 * change.stddev);
    EXPECT_LT(change.stddev, 0.1);
    EXPECT_NEAR(static_cast<double>(change.number), 43.0, 3.0);
    EXPECT_EQ(change.batch, here.palpations[change.number].batch);
    EXPECT_NEAR(here.level->value, there.level->value, 0.15);
    // What was felt stays as it was felt.
    EXPECT_EQ(here.palpations.back().reading, felt(tissue(), shifted, seed).back().reading);
  }
}

TEST(ZeroChanges, AreFoundWhereThereAreTwo) {
  const World twice = [](const Vec3& place, int i) {
    return stiffness(place) + (i >= 30 ? 1.2 : 0.0) - (i >= 70 ? 2.0 : 0.0);
  };
  const Conclusion conclusion = concluded(twice, 2);
  ASSERT_EQ(conclusion.evidence.zero_changes.size(), 2u);
  for (const ZeroChange& change : conclusion.evidence.zero_changes) {
    const bool is_first = change.number < 50;
    EXPECT_NEAR(change.amount, is_first ? 1.2 : -2.0, 4.0 * change.stddev);
  }
}

TEST(ZeroChanges, AreNotWhatTissueThatMovedReads) {
  const World moved = [](const Vec3& place, int i) {
    return stiffness(i >= 50 ? place - Vec3(0.004, 0.003, 0.0) : place);
  };
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    EXPECT_TRUE(concluded(moved, seed).evidence.zero_changes.empty()) << seed;
}

/// Row by row, stiff from some row on: the tissue steps when time does.
TEST(ZeroChanges, AreNotWhatARasterFindsOverTissueThatIsStiffBeyondALine) {
  const Surface surface = tissue();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Random random(seed);
    std::vector<Palpation> raster;
    for (int i = 0; i < kReadings; ++i) {
      const int row = i / 10;
      const Vec3 place(0.0015 + 0.0024 * row, 0.0015 + 0.0024 * (i % 10), 0.0);
      const double stiff = 2.0 / (1.0 + std::exp(-1400.0 * (place.x() - 0.0125)));
      raster.push_back({.where = surface.project(place),
                        .reading = 7.0 + stiff + kNoise * random.normal(),
                        .batch = row});
    }
    const Conclusion conclusion =
        conclude(surface, {.level = {.estimate = LevelEstimate::Edge}}, raster);
    EXPECT_TRUE(conclusion.evidence.zero_changes.empty()) << seed;
    EXPECT_NEAR(conclusion.level->value, 8.0, 0.2);
    for (const Misfit& misfit : misfits(conclusion)) EXPECT_NE(misfit.kind, MisfitKind::Zero);
  }
}

/// The probe goes on where it found something: what comes later is stiff.
TEST(ZeroChanges, AreNotATumourThatIsTouchedLast) {
  const Surface surface = tissue();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    std::vector<Palpation> palpations = felt(surface, sound, seed);
    const auto is_outside = [&](const Palpation& one) {
      return (surface.position(one.where) - Vec3(0.0105, 0.0125, 0.0)).norm() > 0.006;
    };
    std::ranges::stable_partition(palpations, is_outside);
    for (std::size_t i = 0; i < palpations.size(); ++i)
      palpations[i].batch = static_cast<int>(i / 10);
    EXPECT_TRUE(conclude(surface, {.level = {.estimate = LevelEstimate::Edge}}, palpations)
                    .evidence.zero_changes.empty())
        << seed;
  }
}

}  // namespace
}  // namespace palpation
