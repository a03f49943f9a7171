#include "exploration/taken_back.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "palpation/base/random.h"
#include "palpation/exploration/conclusion.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/readings/screening.h"

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
std::vector<Palpation> felt(const Surface& surface, const World& world, std::uint64_t seed,
                            int readings = kReadings) {
  Random random(seed);
  std::vector<Palpation> palpations;
  for (int i = 0; i < readings; ++i) {
    const auto vertex = static_cast<int>(random.uniform() * surface.vertex_count());
    palpations.push_back({.where = surface.at_vertex(vertex),
                          .reading = world(surface.vertex(vertex), i) + kNoise * random.normal(),
                          .batch = 10 * i / readings});
  }
  return palpations;
}

Conclusion concluded(const World& world, std::uint64_t seed,
                     std::optional<std::uint64_t> sampling_seed = std::nullopt) {
  const Surface surface = tissue();
  return conclude(surface, {.level = {.estimate = LevelEstimate::Edge}}, felt(surface, world, seed),
                  nullptr, sampling_seed);
}

double sound(const Vec3& place, int) { return stiffness(place); }

TEST(ZeroChanges, AreSeldomSeenWhereThereIsNone) {
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
    seen += !concluded(sound, seed).evidence.taken_back.empty();
  EXPECT_LE(seen, 4);  // 2 in 100 at most; more than 4 in one of 200 such tests
}

TEST(ZeroChanges, AreTakenBackAsIfTheZeroHadStayed) {
  const World shifted = [](const Vec3& place, int i) {
    return stiffness(place) + (i >= 43 ? 1.5 : 0.0);
  };
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Conclusion here = concluded(shifted, seed), there = concluded(sound, seed);
    ASSERT_EQ(here.evidence.taken_back.size(), 1u) << seed;
    const Misfit& change = here.evidence.taken_back.front();
    EXPECT_NEAR(change.amount, 1.5, 4.0 * change.stddev);
    EXPECT_LT(change.stddev, 0.1);
    EXPECT_NEAR(static_cast<double>(change.number), 43.0, 3.0);
    EXPECT_EQ(change.from_batch, here.palpations[change.number].batch);
    EXPECT_NEAR(here.level->value, there.level->value, 0.15);
    // What was felt stays as it was felt.
    EXPECT_EQ(here.palpations.back().reading, felt(tissue(), shifted, seed).back().reading);
  }
}

// One in three of so many is looked at; those between would be as wrong as the zero moved.
TEST(ZeroChanges, AreFoundAtTheReadingTheyCameWithAmongMany) {
  const Surface surface = tissue();
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const int at = 300 + static_cast<int>(seed);
    const World shifted = [&](const Vec3& place, int i) {
      return stiffness(place) + (i >= at ? 1.5 : 0.0);
    };
    const Conclusion conclusion = conclude(surface, {.level = {.estimate = LevelEstimate::Edge}},
                                           felt(surface, shifted, seed, 600));
    ASSERT_EQ(conclusion.evidence.taken_back.size(), 1u) << seed;
    EXPECT_EQ(conclusion.evidence.taken_back.front().number, static_cast<std::size_t>(at)) << seed;
  }
}

TEST(ZeroChanges, AreFoundWhereThereAreTwo) {
  const World twice = [](const Vec3& place, int i) {
    return stiffness(place) + (i >= 30 ? 1.2 : 0.0) - (i >= 70 ? 2.0 : 0.0);
  };
  const Conclusion conclusion = concluded(twice, 2);
  ASSERT_EQ(conclusion.evidence.taken_back.size(), 2u);
  for (const Misfit& change : conclusion.evidence.taken_back) {
    const bool is_first = change.number < 50;
    EXPECT_NEAR(change.amount, is_first ? 1.2 : -2.0, 4.0 * change.stddev);
  }
}

/// Three sessions that take turns, each with a zero of its own; the second feels only the tumour.
std::vector<Palpation> felt_in_sessions(const Surface& surface, const std::array<double, 3>& zeros,
                                        std::uint64_t seed) {
  std::vector<Palpation> palpations = felt(surface, sound, seed);
  for (std::size_t i = 0; i < palpations.size(); ++i) {
    Palpation& one = palpations[i];
    const bool is_stiff = stiffness(surface.position(one.where)) > 8.0;
    one.session = is_stiff && i % 3 == 1 ? 1 : i > 60 ? 2 : 0;
    one.reading += zeros[one.session];
  }
  return palpations;
}

TEST(Sessions, HaveZerosOfTheirOwnHoweverFarApart) {
  const Surface surface = tissue();
  for (const std::uint64_t seed : {1, 2, 3}) {
    for (const auto& zeros :
         {std::array{0.0, 0.0, 0.0}, {0.0, -1.3, 0.7}, {0.0, 40.0, -15.0}, {0.0, 2e6, -1e9}}) {
      const Conclusion conclusion = conclude(surface, {}, felt_in_sessions(surface, zeros, seed));
      const std::vector<Misfit>& changes = conclusion.evidence.taken_back;
      ASSERT_EQ(changes.size(), 2u);
      for (int session = 1; session < 3; ++session) {
        const Misfit& change = changes[static_cast<std::size_t>(session - 1)];
        EXPECT_EQ(change.session, session);
        EXPECT_NEAR(change.amount, zeros[session] - zeros[session - 1], 4.0 * change.stddev);
        EXPECT_LT(change.stddev, 0.15);
      }
      ASSERT_TRUE(conclusion.level);
      EXPECT_NEAR(conclusion.level->value, 8.0, 0.3);
    }
  }
}

/// The second feels only the tumour, with a gain that this cannot tell from its zero; the third
/// feels both.
TEST(Sessions, TellZeroAndGainAsSurelyAsTheirReadingsDo) {
  const Surface surface = tissue();
  for (const std::uint64_t seed : {4, 5, 6}) {
    std::vector<Palpation> palpations = felt_in_sessions(surface, {0.0, -2.0, 5.0}, seed);
    for (Palpation& one : palpations) {
      if (one.session == 2) one.reading += 0.5 * (one.reading - 12.0);
    }
    const std::vector<SessionChange> sessions = session_changes(
        conclude(surface, {.level = {.estimate = LevelEstimate::Edge}}, palpations, nullptr, seed));
    ASSERT_EQ(sessions.size(), 2u);
    const double truth[2] = {-2.0, 7.0}, gain[2] = {1.0, 1.5};
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& [zero, drawn] = sessions[i];
      EXPECT_NEAR(zero.amount, truth[i], 3.0 * zero.stddev) << seed;
      ASSERT_TRUE(drawn);
      EXPECT_GT(drawn->most, 0.95 * gain[i]) << seed;
      EXPECT_LT(drawn->least, 1.05 * gain[i]) << seed;
    }
    EXPECT_GT(sessions[0].zero.stddev, 2.0 * kNoise) << seed;
  }
}

TEST(Sessions, ThatTakeTurnsChangeInTimeTogether) {
  const Surface surface = tissue();
  const World weakening = [](const Vec3& place, int i) {
    return 7.0 + (stiffness(place) - 7.0) * (i >= 50 ? 0.5 : 1.0);
  };
  std::vector<Palpation> palpations = felt(surface, weakening, 1);
  for (std::size_t i = 0; i < palpations.size(); ++i) {
    palpations[i].session = static_cast<int>(i % 2);
    palpations[i].reading += 3.0 * palpations[i].session;
  }
  const Conclusion conclusion =
      conclude(surface, {.level = {.estimate = LevelEstimate::Edge}}, palpations, nullptr, 1);
  const std::vector<SessionChange> sessions = session_changes(conclusion);
  ASSERT_EQ(sessions.size(), 1u);
  EXPECT_NEAR(sessions[0].zero.amount, 3.0, 3.0 * sessions[0].zero.stddev);
  EXPECT_NEAR(sessions[0].gain->mean, 1.0, 0.15);
  const Misfit& gain = conclusion.evidence.taken_back.back();
  EXPECT_EQ(gain.kind, MisfitKind::Gain);
  EXPECT_NEAR(gain.amount, -0.5, 0.1);
  EXPECT_NEAR(static_cast<double>(gain.number), 50.0, 12.0);
}

TEST(TakenBack, AGainIsOfReadingsWithoutTheZeroThatMovedLater) {
  const World world = [](const Vec3& place, int i) {
    const double gained = 7.0 + (stiffness(place) - 7.0) * (i >= 40 ? 0.5 : 1.0);
    return gained + (i >= 70 ? 3.0 : 0.0);
  };
  const Surface surface = tissue();
  const std::vector<Palpation> as_felt = felt(surface, world, 1),
                               as_it_is = felt(surface, sound, 1);
  const std::vector<Palpation> taken_back = readings_as_if_unchanged(concluded(world, 1, 1));
  double off = 0.0;
  for (std::size_t i = 0; i < taken_back.size(); ++i) {
    const double noise = as_it_is[i].reading - stiffness(surface.position(as_it_is[i].where)),
                 is = stiffness(surface.position(as_felt[i].where));
    off += std::abs(taken_back[i].reading - is) - std::abs(noise);
  }
  EXPECT_LT(off / kReadings, kNoise);
}

TEST(Sessions, AreOneToAFieldWithASlope) {
  const Surface surface = tissue();
  std::vector<Palpation> palpations = felt_in_sessions(surface, {0.0, 1.0, 2.0}, 1);
  Model sloped;
  sloped.field.trend.is_linear = true;
  EXPECT_TRUE(conclude(surface, sloped, palpations).evidence.taken_back.empty());
}

TEST(ZeroChanges, AreNotWhatTissueThatMovedReads) {
  const World moved = [](const Vec3& place, int i) {
    return stiffness(i >= 50 ? place - Vec3(0.004, 0.003, 0.0) : place);
  };
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    EXPECT_TRUE(concluded(moved, seed).evidence.taken_back.empty()) << seed;
}

const Vec3 kMove(0.004, 0.003, 0.0);

double moved_at_half(const Vec3& place, int reading) {
  return stiffness(reading >= 50 ? place - kMove : place);
}

TEST(TakenBack, TissueThatMovedIsFeltWhereItLayWhenAllIsKnown) {
  const Conclusion conclusion = concluded(moved_at_half, 3, 1);
  ASSERT_EQ(conclusion.evidence.taken_back.size(), 1u);
  const Misfit& change = conclusion.evidence.taken_back.front();
  EXPECT_EQ(change.kind, MisfitKind::Moved);
  EXPECT_NEAR(static_cast<double>(change.number), 50.0, 2.0);
  EXPECT_LT((change.moved_m - kMove).norm(), 0.0003);
  EXPECT_EQ(change.amount, change.moved_m.norm());
  // The disk, where it lay; and what was felt stays as it was felt, where it was.
  const double truth_m2 = 36e-6 * 3.14159265358979;
  EXPECT_NEAR(conclusion.outlines->area_m2.mean, truth_m2, 0.1 * truth_m2);
  EXPECT_LT(conclusion.outlines->expected.symmetric_difference_m2(), 0.2 * truth_m2);
  EXPECT_TRUE(misfits(conclusion).empty());
  const Palpation last = felt(tissue(), moved_at_half, 3).back();
  EXPECT_EQ(conclusion.palpations.back().reading, last.reading);
  EXPECT_EQ(conclusion.palpations.back().where.barycentric, last.where.barycentric);
}

// On the way two readings are taken as one: which was the first that differs is counted in those
// that were made.
TEST(TakenBack, ItIsSaidSinceWhichReadingAlsoWhereSomeOnTheWayAreOne) {
  const Surface surface = tissue();
  Random random(8);
  std::vector<Palpation> slides;
  for (int row = 0; row < 24; ++row) {
    for (int i = 0; i < 25; ++i) {
      const Vec3 place(0.0005 + 0.00098 * i, 0.0005 + 0.001 * ((7 * row + 7) % 24), 0.0);
      slides.push_back(
          {.where = surface.project(place),
           .reading = stiffness(row >= 12 ? place - kMove : place) + kNoise * random.normal(),
           .batch = row / 4,
           .kind = TouchKind::Way,
           .travel = Vec3::UnitX()});
    }
  }
  const Conclusion conclusion =
      conclude(surface, {.level = {.estimate = LevelEstimate::Edge}}, slides, nullptr, 1);
  EXPECT_LT(conclusion.belief.palpations().size(), 0.7 * static_cast<double>(slides.size()));
  ASSERT_EQ(conclusion.evidence.taken_back.size(), 1u);
  const Misfit& change = conclusion.evidence.taken_back.front();
  // 12 rows of 25; the second half of a row is healthy, wherever it lies, and every other reading
  // is looked at.
  EXPECT_NEAR(static_cast<double>(change.number), 300.0, 17.0);
  EXPECT_EQ(change.from_batch, conclusion.palpations[change.number].batch);
  EXPECT_LT((change.moved_m - kMove).norm(), 0.0003);
}

// Row by row no ground is felt again: the second lobe looks like the first, laid elsewhere.
TEST(TakenBack, ARasterOfTwoLobesIsNoTissueThatMoved) {
  Random random(1);
  const Surface surface(make_plane({.size_m = {0.040, 0.060}, .columns = 41, .rows = 61}, random));
  std::vector<Palpation> palpations;
  for (int i = 0; i < 150; ++i) {
    const int row = i / 10, along = row % 2 == 0 ? i % 10 : 9 - i % 10;
    const Vec3 place(0.0015 + 0.004 * along + 0.0003 * random.normal(),
                     0.0015 + 0.004 * row + 0.0003 * random.normal(), 0.0);
    const Vec3 one(0.013, 0.022, 0.0), other(0.025, 0.040, 0.0), way = other - one;
    const double along_neck = std::clamp((place - one).dot(way) / way.squaredNorm(), 0.0, 1.0);
    const double depth_m = std::max({0.006 - (place - one).norm(), 0.007 - (place - other).norm(),
                                     0.0018 - (place - one - along_neck * way).norm()});
    palpations.push_back(
        {.where = surface.project(place),
         .reading = 7.0 + 2.0 / (1.0 + std::exp(-1400.0 * depth_m)) + kNoise * random.normal()});
  }
  const Conclusion conclusion = conclude(surface, {}, palpations);
  ASSERT_TRUE(conclusion.contour);
  EXPECT_TRUE(std::ranges::none_of(
      misfits(conclusion), [](const Misfit& one) { return one.kind == MisfitKind::Moved; }));
}

// Until then it is said: to ask costs a tenth of a second.
TEST(TakenBack, WhileOneLooksTissueThatMovedIsAMisfit) {
  const Conclusion conclusion = concluded(moved_at_half, 3);
  EXPECT_TRUE(conclusion.evidence.taken_back.empty());
  const std::vector<Misfit> found = misfits(conclusion);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().kind, MisfitKind::Moved);
}

TEST(TakenBack, WhatWasFeltWhereNoTissueLayBeforeItMovedIsSetAside) {
  const Surface surface = tissue();
  const Misfit moved{.kind = MisfitKind::Moved, .from_batch = 1, .number = 1, .moved_m = kMove};
  std::vector<Palpation> palpations(3);
  for (std::size_t i = 0; i < palpations.size(); ++i)
    palpations[i] = {.where = surface.at_vertex(0), .reading = 7.0, .batch = 1};
  palpations.back().where = surface.project({0.01, 0.01, 0.0});
  const std::vector<Palpation> before = with_changes_taken_back(surface, palpations, {{moved}});
  EXPECT_EQ(before[0].set_aside, "");
  EXPECT_EQ(before[1].set_aside, kBeyondTissue);
  EXPECT_EQ(before[2].set_aside, "");
  EXPECT_LT((surface.position(before[2].where) - Vec3(0.006, 0.007, 0.0)).norm(), 1e-9);
}

// Rows of healthy tissue, put upon each other, would agree as well: no outline is likelier for it.
TEST(TakenBack, ARasterIsNoMove) {
  const Surface surface = tissue();
  Random random(5);
  std::vector<Palpation> raster;
  for (int i = 0; i < 121; ++i) {
    const Vec3 place(0.0015 + 0.0022 * (i / 11), 0.0015 + 0.0022 * (i % 11), 0.0);
    raster.push_back(
        {.where = surface.project(place), .reading = stiffness(place) + 0.02 * random.normal()});
  }
  const Conclusion conclusion =
      conclude(surface, {.level = {.estimate = LevelEstimate::Edge}}, raster, nullptr, 1);
  EXPECT_TRUE(conclusion.evidence.taken_back.empty());
  EXPECT_FALSE(conclusion.evidence.zero_or_tissue);
  for (const Misfit& misfit : misfits(conclusion)) EXPECT_NE(misfit.kind, MisfitKind::Moved);
  const double truth_m2 = 36e-6 * 3.14159265358979;
  EXPECT_NEAR(conclusion.outlines->area_m2.mean, truth_m2, 0.05 * truth_m2);
}

/// Row by row, then around the edge: the first rows are healthy wherever the tissue lies.
std::vector<Palpation> rows_then_edge(const Surface& surface, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> places;
  const auto off = [&] { return 0.0004 * random.normal(); };
  for (int row = 0; row < 12; ++row) {
    for (int column = 0; column < 10; ++column)
      places.emplace_back(0.002 + 0.0023 * column + off(), 0.0015 + 0.002 * row + off(), 0.0);
  }
  for (int i = 0; i < 80; ++i) {
    const double angle = 0.0785 * i, radius_m = 0.006 + 2.0 * off();
    places.emplace_back(0.0105 + radius_m * std::cos(angle), 0.0125 + radius_m * std::sin(angle),
                        0.0);
  }
  std::vector<Palpation> palpations;
  for (const Vec3& place : places) {
    const SurfacePoint where = surface.project(place);
    palpations.push_back(
        {.where = where, .reading = stiffness(surface.position(where)) + 0.04 * random.normal()});
  }
  return palpations;
}

TEST(TakenBack, OfHealthyTissueAloneNothingTellsWhereItLay) {
  const Surface surface = tissue();
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Conclusion conclusion = conclude(surface, {}, rows_then_edge(surface, seed));
    for (const Misfit& misfit : misfits(conclusion))
      EXPECT_NE(misfit.kind, MisfitKind::Moved) << seed << ": " << misfit.amount;
  }
}

TEST(TakenBack, AGainThatChangedIsFeltAsBefore) {
  const World amplified = [](const Vec3& place, int i) {
    return 7.0 + (stiffness(place) - 7.0) * (i >= 50 ? 0.5 : 1.0);
  };
  const Conclusion conclusion = concluded(amplified, 4, 1);
  ASSERT_EQ(conclusion.evidence.taken_back.size(), 1u);
  const Misfit& change = conclusion.evidence.taken_back.front();
  EXPECT_EQ(change.kind, MisfitKind::Gain);
  EXPECT_NEAR(change.amount, -0.5, 0.1);
  const double truth_m2 = 36e-6 * 3.14159265358979;
  EXPECT_NEAR(conclusion.outlines->area_m2.mean, truth_m2, 0.1 * truth_m2);
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
    EXPECT_TRUE(conclusion.evidence.taken_back.empty()) << seed;
    EXPECT_NEAR(conclusion.level->value, 8.0, 0.2);
    for (const Misfit& misfit : misfits(conclusion)) EXPECT_NE(misfit.kind, MisfitKind::Zero);
  }
}

/// Row by row, as many a row, of readings that scatter by a fiftieth of the contrast.
Conclusion concluded_of_raster(const World& world, std::uint64_t seed, int rows = 7) {
  const Surface surface = tissue();
  Random random(seed);
  std::vector<Palpation> raster;
  const double apart_m = 0.0216 / (rows - 1);
  for (int i = 0; i < rows * rows; ++i) {
    const Vec3 place(0.0017 + apart_m * (i / rows), 0.0017 + apart_m * (i % rows), 0.0);
    raster.push_back(
        {.where = surface.project(place), .reading = world(place, i) + 0.04 * random.normal()});
  }
  return conclude(surface, {.level = {.estimate = LevelEstimate::Edge}}, raster, nullptr, 1);
}

// As one outline of what is stiff, half of the tissue would be: with the disk, of two heights.
TEST(RasterStep, OfTheZeroWithinATumourIsTakenBack) {
  const Conclusion conclusion = concluded_of_raster(
      [](const Vec3& place, int i) { return stiffness(place) - (i >= 21 ? 2.0 : 0.0); }, 1);
  ASSERT_EQ(conclusion.evidence.taken_back.size(), 1u);
  const Misfit& change = conclusion.evidence.taken_back.front();
  EXPECT_EQ(change.kind, MisfitKind::Zero);
  EXPECT_EQ(change.number, 21u);
  EXPECT_NEAR(change.amount, -2.0, 0.2);
  EXPECT_FALSE(conclusion.evidence.zero_or_tissue);
  const double truth_m2 = 36e-6 * 3.14159265358979;
  EXPECT_NEAR(conclusion.outlines->area_m2.mean, truth_m2, 0.1 * truth_m2);
}

TEST(RasterStep, OfTheZeroIsNoSlopeOfTheTissue) {
  const Conclusion conclusion = concluded_of_raster(
      [](const Vec3& place, int i) { return stiffness(place) + (i >= 50 ? 0.8 : 0.0); }, 1, 10);
  ASSERT_EQ(conclusion.evidence.taken_back.size(), 1u);
  const Misfit& change = conclusion.evidence.taken_back.front();
  EXPECT_EQ(change.kind, MisfitKind::Zero);
  EXPECT_EQ(change.number, 50u);
  EXPECT_NEAR(change.amount, 0.8, 0.1);
}

TEST(RasterStep, OfTissueThatIsStiffBeyondALineMayBeTheZeros) {
  const Conclusion conclusion = concluded_of_raster(
      [](const Vec3& place, int) {
        return 7.0 + 2.0 / (1.0 + std::exp(-1400.0 * (place.x() - 0.0143)));
      },
      1);
  EXPECT_TRUE(conclusion.evidence.taken_back.empty());
  EXPECT_NEAR(conclusion.level->value, 8.0, 0.4);
  ASSERT_TRUE(conclusion.evidence.zero_or_tissue);
  EXPECT_EQ(conclusion.evidence.zero_or_tissue->number, 28u);
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
                    .evidence.taken_back.empty())
        << seed;
  }
}

/// Here and there, and then close together on what is stiff: those here and there that lie beside
/// it have no others as near.
TEST(ZeroChanges, AreNotALumpThatIsFeltCloselyAfterALook) {
  const Surface surface = tissue();
  const Vec3 middle(0.0105, 0.0125, 0.0);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Random random(seed);
    std::vector<Palpation> palpations;
    const auto touch = [&](const Vec3& place) {
      palpations.push_back({.where = surface.project(place),
                            .reading = stiffness(place) + kNoise * random.normal()});
    };
    while (palpations.size() < 20) {
      const Vec3 place(0.025 * random.uniform(), 0.025 * random.uniform(), 0.0);
      if ((place - middle).norm() > 0.008) touch(place);
    }
    while (palpations.size() < 60) {
      const double angle = 6.283 * random.uniform(), radius_m = 0.005 * std::sqrt(random.uniform());
      touch(middle + radius_m * Vec3(std::cos(angle), std::sin(angle), 0.0));
    }
    const Conclusion conclusion =
        conclude(surface, {.level = {.estimate = LevelEstimate::Edge}}, palpations);
    EXPECT_TRUE(conclusion.evidence.taken_back.empty()) << seed;
  }
}

}  // namespace
}  // namespace palpation
