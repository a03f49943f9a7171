// Screening in the loop: what a probe's fault does to an exploration, and that a sound probe loses
// nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "belief/tissue.h"
#include "certainty/contrast.h"
#include "palpation/boundary/level_set.h"
#include "palpation/exploration/exploration.h"
#include "palpation/readings/screening.h"
#include "palpation/world/phantom.h"

namespace palpation {
namespace {

int set_aside_in(const Exploration& exploration) {
  const std::vector<Palpation>& all = exploration.conclusion().palpations;
  return static_cast<int>(std::count_if(
      all.begin(), all.end(), [](const Palpation& one) { return !one.set_aside.empty(); }));
}

FieldModel screened_field() { return {.probe = {.screening = true}}; }

// Tumours down to 2.5 mm, little and much noise, with a lag that is not known of, none, and one
// that is: next to nothing is set aside, and never in the first touches, where one of them may be
// all that was felt of a tumour.
TEST(ScreenedExploration, ASoundProbeLosesNextToNothing) {
  const Surface tissue = plane(26, 51);
  int readings = 0, lost = 0;
  for (const double noise : {0.01, 0.05, 0.25}) {
    for (const double lag_m : {0.0, 0.0015}) {
      for (const bool known : {false, true}) {
        const Phantom phantom(tissue,
                              {Disk{Vec3(0.0115, 0.030, 0.0), noise > 0.1 ? 0.006 : 0.0025}},
                              {.noise = noise, .lag_m = lag_m});
        FieldModel field = screened_field();
        if (known) field.probe.lag_m = lag_m;
        Exploration exploration(tissue, {.field = field, .level = {.known = 8.0}},
                                {.acquisition = straddle(),
                                 .initial = {.design = Design::Random, .count = 10, .seed = 5},
                                 .batches = 6});
        Random random(5);
        int first = -1;
        run(
            exploration,
            [&](const SurfacePoint& where, const Vec3& travel) {
              return std::optional(phantom.touch(where, travel, random));
            },
            [&](const Tour&) { first = first < 0 ? set_aside_in(exploration) : first; });
        EXPECT_EQ(first, 0) << noise << " " << lag_m;
        readings += static_cast<int>(exploration.conclusion().palpations.size());
        lost += set_aside_in(exploration);
      }
    }
  }
  EXPECT_LE(lost, readings / 200) << readings;
}

/// Readings of healthy tissue, one of which failed.
std::vector<Palpation> healthy_but_one(const Surface& tissue, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Palpation> readings;
  for (int i = 0; i < count; ++i)
    readings.push_back(
        touch(tissue, random.below(tissue.vertex_count()), 7.0 + 0.1 * random.normal()));
  readings[static_cast<std::size_t>(count / 3)].reading = 8.5;
  return readings;
}

TEST(Exploration, FindsNoTumourInOneReadingOfAHundred) {
  const Surface tissue = plane(41, 41);
  for (const bool trend : {false, true}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const std::vector<Palpation> readings = healthy_but_one(tissue, 100, seed);
      Exploration exploration(tissue, {.field = {.trend = {.is_linear = trend}}});
      exploration.take_up(readings);
      EXPECT_FALSE(exploration.conclusion().evidence.contrast_seen) << seed << " " << trend;
      EXPECT_FALSE(exploration.conclusion().level) << seed << " " << trend;
      const Conclusion& conclusion = exploration.conclusion();
      const bool is_set_aside = conclusion.palpations[33].set_aside == kOutlier;
      EXPECT_EQ(conclusion.evidence.standing_alone.size(), is_set_aside ? 0u : 1u)
          << seed << " " << trend;
      for (const Palpation& alone : conclusion.evidence.standing_alone)
        EXPECT_EQ(tissue.vertex_at(alone.where), tissue.vertex_at(readings[33].where)) << seed;
    }
  }
}

// Of readings on the way two or three become one, and what is named is named as it was made.
TEST(Exploration, NamesTheReadingThatStandsAloneBesideThoseOnTheWay) {
  const Surface tissue = plane(41, 41);
  std::size_t named = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Random random(seed);
    std::vector<Palpation> readings;
    for (int i = 0; i < 60; ++i)
      readings.push_back({.where = tissue.project(Vec3(0.005 + 0.0005 * i, 0.001, 0.0)),
                          .reading = 7.0 + 0.1 * random.normal(),
                          .kind = TouchKind::Way,
                          .travel = Vec3::UnitX()});
    std::ranges::copy(healthy_but_one(tissue, 100, seed), std::back_inserter(readings));
    Exploration exploration(tissue, {.field = {.trend = {.is_linear = true}}});
    exploration.take_up(readings);
    const Conclusion& conclusion = exploration.conclusion();
    for (const Palpation& alone : conclusion.evidence.standing_alone) {
      EXPECT_EQ(alone.reading, 8.5) << seed;
      ++named;
    }
  }
  EXPECT_GT(named, 0u);
}

// It would drown the tumour in its noise, or be outlined in its place.
TEST(Exploration, FindsATumourBesideAReadingThatStandsAlone) {
  const Surface tissue = plane(41, 41);
  const double tumour_mm2 = 1e6 * std::numbers::pi * 0.006 * 0.006;
  for (const double wild : {-60.0, 60.0}) {
    for (const bool learned : {false, true}) {
      std::vector<Palpation> readings = healthy_but_one(tissue, 200, 4);
      for (Palpation& palpation : readings) {
        const double depth_m = 0.006 - (tissue.position(palpation.where) -
                                        tissue.position(tissue.at_vertex(20 * 41 + 20)))
                                           .norm();
        palpation.reading += 2.0 / (1.0 + std::exp(-1400.0 * depth_m));
      }
      readings[66].reading = wild;
      FieldModel field;
      if (!learned) {
        field.kernel = {.length_m = 0.004, .signal_sd = 1.0};
        field.noise.sd = 0.1;
      }
      Exploration exploration(tissue, {.field = field});
      exploration.take_up(std::span(readings).first(100));
      exploration.take_up(std::span(readings).subspan(100));
      EXPECT_NE(exploration.conclusion().palpations[66].set_aside, "") << wild << learned;
      ASSERT_TRUE(exploration.conclusion().level) << wild << learned;
      const Contour& contour = *exploration.conclusion().contour;
      EXPECT_NEAR(1e6 * superlevel_area(tissue, contour.field, contour.level), tumour_mm2,
                  0.1 * tumour_mm2)
          << wild << learned;
    }
  }
}

// What is felt again is no fault.
TEST(Exploration, FindsATumourThatASecondReadingConfirms) {
  const Surface tissue = plane(41, 41);
  std::vector<Palpation> readings = healthy_but_one(tissue, 100, 1);
  readings.push_back(readings[33]);
  readings.back().reading = 8.6;
  Exploration exploration(tissue);
  exploration.take_up(readings);
  EXPECT_TRUE(exploration.conclusion().evidence.contrast_seen);
  EXPECT_TRUE(exploration.conclusion().evidence.standing_alone.empty());
}

TEST(ScreenedExploration, FindsASensorThatHangsAndKeepsTheReasonWithTheReading) {
  const Surface tissue = plane(26, 51);
  std::vector<Palpation> hung;
  constexpr double kLive[] = {7.0, 7.04, 7.01, 7.05, 7.03};
  for (int vertex = 0; vertex < 20; ++vertex)
    hung.push_back(touch(tissue, 26 * vertex, vertex < 5 ? kLive[vertex] : 7.02));
  Exploration exploration(tissue);
  exploration.take_up(hung);
  const std::vector<Palpation>& told = exploration.conclusion().palpations;
  ASSERT_EQ(told.size(), 20u);
  for (std::size_t i = 0; i < told.size(); ++i) EXPECT_EQ(told[i].set_aside, i < 5 ? "" : kFrozen);
  EXPECT_EQ(exploration.conclusion().belief.site_count(), 5);
}

}  // namespace
}  // namespace palpation
