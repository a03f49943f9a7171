#include "palpation/certainty/misfit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "palpation/base/error.h"
#include "palpation/base/random.h"
#include "palpation/certainty/edge_belief.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

constexpr double kRadius_m = 0.006, kSlope = 1400.0, kNoise = 0.1;
constexpr int kReadings = 100;  // in ten batches

Surface tissue() {
  Random random(0);
  return Surface(make_plane({.size_m = {0.025, 0.025}, .columns = 51, .rows = 51}, random));
}

double depth_in_disk(const Vec3& place) {
  return kRadius_m - (place - Vec3(0.0105, 0.0125, 0.0)).norm();
}

/// 7 outside and 9 inside.
double stiffness_at(double depth_m) { return 7.0 + 2.0 / (1.0 + std::exp(-kSlope * depth_m)); }
double stiffness(const Vec3& place) { return stiffness_at(depth_in_disk(place)); }

/// What is felt at a place in a batch, without noise.
using World = std::function<double(const Vec3&, int batch)>;

/// Whether the next reading may be made there, as so many were made.
using Design = std::function<bool(const Vec3&, int made)>;

/// Every second one near the edge.
bool by_turns(const Vec3& place, int made) {
  return made % 2 == 0 || std::abs(depth_in_disk(place)) <= 0.0015;
}

/// Of readings at random vertices.
Belief belief_of(const Surface& surface, const World& world, std::uint64_t seed, int readings,
                 const Design& design = by_turns, double believed_noise = kNoise) {
  Random random(seed);
  const Prior prior(surface, Metric::Chart, Kernel{.length_m = 0.0045, .signal_sd = 1.0});
  std::vector<Palpation> palpations;
  while (static_cast<int>(palpations.size()) < readings) {
    const auto vertex = static_cast<int>(random.uniform() * surface.vertex_count());
    const Vec3 place = surface.vertex(vertex);
    const int made = static_cast<int>(palpations.size()), batch = made / (readings / 10);
    if (!design(place, made)) continue;
    palpations.push_back({.where = surface.at_vertex(vertex),
                          .reading = world(place, batch) + kNoise * random.normal(),
                          .batch = batch});
  }
  return Belief(prior, {.noise_sd = believed_noise}).condition_on(palpations);
}

EdgeBelief edge_of(const Belief& belief) {
  constexpr double kFirstLevels[] = {8.0};
  return EdgeBelief::around(belief, belief.at_vertices(), kFirstLevels, 0.5).value();
}

/// What surprises.
std::vector<Misfit> misfits_of(const World& world, std::uint64_t seed, int readings) {
  const Surface surface = tissue();
  const Belief belief = belief_of(surface, world, seed, readings);
  std::vector<Misfit> found = edge_of(belief).misfits();
  const std::optional<Misfit> change = changed_since(belief);
  if (change && change->kind == MisfitKind::Moved) found.push_back(*change);
  std::ranges::stable_sort(found, std::greater{}, &Misfit::evidence);
  return found;
}

/// Of twenty runs, how many are surprised by that before all else.
int said_in(const World& world, MisfitKind kind, int readings = kReadings) {
  int said = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<Misfit> found = misfits_of(world, seed, readings);
    said += !found.empty() && found.front().kind == kind;
  }
  return said;
}

/// Of the first run that is surprised, what surprises the most.
Misfit first_of(const World& world, int readings = kReadings) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<Misfit> found = misfits_of(world, seed, readings);
    if (!found.empty()) return found.front();
  }
  ADD_FAILURE() << "nothing surprises";
  return {};
}

TEST(Misfit, IsSeldomSeenWhereTheModelIsTrue) {
  const World sound = [](const Vec3& place, int) { return stiffness(place); };
  int doubted = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
    doubted += !misfits_of(sound, seed, kReadings).empty();
  EXPECT_LE(doubted, 4);  // 2 in 100; more than 4 in one of 200 such tests
}

TEST(Misfit, IsAZeroThatMovedByAQuarterOfTheContrast) {
  const World shifted = [](const Vec3& place, int batch) {
    return stiffness(place) + (batch >= 6 ? 0.5 : 0.0);
  };
  EXPECT_GE(said_in(shifted, MisfitKind::Zero), 18);
  const Misfit first = first_of(shifted);
  EXPECT_NEAR(first.amount, 0.5, 0.2);
  EXPECT_NEAR(first.from_batch, 6, 1);
}

// It is felt the more often the later, and readings lie lower there: by themselves those since then
// surprise in one of these runs.
TEST(Misfit, IsNoChangeWhereSomethingSoftIsFeltMoreAndMore) {
  const auto depth_in_cyst = [](const Vec3& place) {
    return 0.005 - (place - Vec3(0.0215, 0.0205, 0.0)).norm();
  };
  const World with_cyst = [&](const Vec3& place, int) {
    return stiffness(place) - 1.3 / (1.0 + std::exp(-kSlope * depth_in_cyst(place)));
  };
  const Design edges_last = [&](const Vec3& place, int made) {
    return made < 120 ||
           std::min(std::abs(depth_in_disk(place)), std::abs(depth_in_cyst(place))) <= 0.0015;
  };
  const Surface surface = tissue();
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const std::vector<Misfit> found =
        edge_of(belief_of(surface, with_cyst, seed, 180, edges_last)).misfits();
    ASSERT_EQ(found.size(), 1U) << seed;
    EXPECT_EQ(found.front().kind, MisfitKind::WeakerPart) << seed;
    EXPECT_LT(found.front().amount, -0.5) << seed;
  }
}

TEST(Misfit, IsAGainThatChanged) {
  const World weaker = [](const Vec3& place, int batch) {
    return 7.0 + (stiffness(place) - 7.0) * (batch >= 5 ? 0.6 : 1.0);
  };
  EXPECT_GE(said_in(weaker, MisfitKind::Gain), 18);
  EXPECT_NEAR(first_of(weaker).amount, -0.4, 0.15);
}

/// The tissue lies elsewhere from batch 5 on.
World moved_by(const Vec3& move_m) {
  return [move_m](const Vec3& place, int batch) {
    return stiffness(batch >= 5 ? place - move_m : place);
  };
}

TEST(Misfit, IsTissueThatMovedByTwoMillimetres) {
  const Vec3 move_m(0.0012, -0.0016, 0.0);
  EXPECT_GE(said_in(moved_by(move_m), MisfitKind::Moved), 18);
  const Misfit first = first_of(moved_by(move_m));
  EXPECT_LT((first.moved_m - move_m).norm(), 0.001);
  EXPECT_NEAR(first.from_batch, 5, 1);
}

TEST(Misfit, IsTissueThatMovedByFiveMillimetres) {
  const Vec3 move_m(0.004, 0.003, 0.0);
  EXPECT_GE(said_in(moved_by(move_m), MisfitKind::Moved), 18);
}

TEST(Misfit, IsOftenAWeakerPartBesideTheTumour) {
  const Vec3 there(0.021, 0.0125, 0.0);
  const World two = [&](const Vec3& place, int) {
    return stiffness(place) + 0.6 / (1.0 + std::exp(1000.0 * ((place - there).norm() - 0.004)));
  };
  EXPECT_GE(said_in(two, MisfitKind::WeakerPart, 200), 7);
  const Misfit first = first_of(two, 200);
  ASSERT_TRUE(first.where);
  EXPECT_LT((tissue().position(*first.where) - there).norm(), 0.003);
  EXPECT_GT(first.amount, 0.0);
}

/// A part of 15 % of the contrast, as high as one and a half standard deviations of the noise.
TEST(Misfit, ThatDoesNotSurpriseIsWhereToLookAgain) {
  const Vec3 there(0.021, 0.0125, 0.0);
  const World two = [&](const Vec3& place, int) {
    return stiffness(place) + 0.3 / (1.0 + std::exp(1000.0 * ((place - there).norm() - 0.004)));
  };
  const Surface surface = tissue();
  int looked = 0, said = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const EdgeBelief edge = edge_of(belief_of(surface, two, seed, kReadings));
    const std::optional<Misfit> most = edge.stands_out_most();
    looked += most && (surface.position(*most->where) - there).norm() < 0.005;
    said += std::ranges::count(edge.misfits(), MisfitKind::WeakerPart, &Misfit::kind) > 0;
    EXPECT_TRUE(!most || most->amount > 0.0);
  }
  EXPECT_GE(looked, 15);
  EXPECT_LE(said, 10);
}

constexpr int kEverywhere = 200;  // readings, at random

/// A field takes for noise what it cannot follow.

EdgeBelief edge_felt_everywhere(const Surface& surface, const World& world, std::uint64_t seed) {
  const Design anywhere = [](const Vec3&, int) { return true; };
  return edge_of(belief_of(surface, world, seed, kEverywhere, anywhere, 3.0 * kNoise));
}

/// Of so many runs, those in which readings since some moment have an outline of their own.
int with_another_outline(const World& world, int runs) {
  const Surface surface = tissue();
  int found = 0;
  for (int seed = 1; seed <= runs; ++seed)
    found += edge_felt_everywhere(surface, world, static_cast<std::uint64_t>(seed))
                 .outline_since()
                 .has_value();
  return found;
}

double grown(const Vec3& place, int batch) {
  return stiffness_at(depth_in_disk(place) + (batch >= 5 ? 0.0015 : 0.0));
}

TEST(OutlineSince, IsSeenWhereATumourGrew) { EXPECT_GE(with_another_outline(grown, 20), 19); }

TEST(OutlineSince, SaysSinceWhenWhereAndByHowMuch) {
  const Surface surface = tissue();
  const std::optional<Misfit> since = edge_felt_everywhere(surface, grown, 1).outline_since();
  ASSERT_TRUE(since && since->where);
  EXPECT_EQ(since->kind, MisfitKind::Outline);
  EXPECT_NEAR(since->from_batch, 5, 1);
  EXPECT_NEAR(since->amount, 0.0015, 0.0007);
  EXPECT_LT(std::abs(depth_in_disk(surface.position(*since->where))), 0.0025);
}

TEST(OutlineSince, IsSeldomSeenWhereThereIsNone) {
  const World sound = [](const Vec3& place, int) { return stiffness(place); };
  EXPECT_LE(with_another_outline(sound, 50), 3);
}

TEST(OutlineSince, IsNeitherAZeroNorAGainThatChanged) {
  const World changed = [](const Vec3& place, int batch) {
    return batch >= 5 ? 6.0 + 0.7 * stiffness(place) : stiffness(place);
  };
  EXPECT_LE(with_another_outline(changed, 20), 2);
}

TEST(Misfit, RefusesARateThatIsNone) {
  const Surface surface = tissue();
  const World sound = [](const Vec3& place, int) { return stiffness(place); };
  const Prior prior(surface, Metric::Chart, Kernel{.length_m = 0.0045, .signal_sd = 1.0});
  std::vector<Palpation> palpations;
  for (int vertex = 0; vertex < surface.vertex_count(); vertex += 40)
    palpations.push_back(
        {.where = surface.at_vertex(vertex), .reading = sound(surface.vertex(vertex), 0)});
  const Belief belief = Belief(prior, {.noise_sd = kNoise}).condition_on(palpations);
  constexpr double kFirstLevels[] = {8.0};
  const EdgeBelief edge =
      EdgeBelief::around(belief, belief.at_vertices(), kFirstLevels, 0.5).value();
  EXPECT_THROW(static_cast<void>(edge.misfits(0.0)), InvalidInput);
  EXPECT_THROW(static_cast<void>(edge.misfits(1.0)), InvalidInput);
  EXPECT_THROW(static_cast<void>(edge.outline_since({}, 0.0)), InvalidInput);
}

}  // namespace
}  // namespace palpation
