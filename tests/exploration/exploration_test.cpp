#include "palpation/exploration/exploration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "belief/tissue.h"
#include "certainty/contrast.h"
#include "palpation/base/error.h"
#include "palpation/exploration/reach.h"
#include "palpation/world/phantom.h"

namespace palpation {
namespace {

Phantom disk_phantom(const Surface& tissue, double noise) {
  return Phantom(tissue, {Disk{Vec3(0.0115, 0.030, 0.0), 0.00625}}, {.noise = noise});
}

Probe probe_of(const Phantom& phantom, Random& random) {
  return [&](const SurfacePoint& where, const Vec3&) {
    return std::optional(phantom.touch(where, random));
  };
}

TEST(Exploration, AsksForTheInitialDesignThenForBatchesThenStops) {
  const Surface tissue = plane(26, 51);
  const Phantom phantom = disk_phantom(tissue, 0.05);
  Exploration exploration(tissue, {}, {.batches = 3});
  Random random(1);
  std::vector<std::size_t> sizes;
  run(exploration, probe_of(phantom, random),
      [&](const Tour& tour) { sizes.push_back(tour.palpations.size()); });
  EXPECT_EQ(sizes, (std::vector<std::size_t>{16, 10, 10, 10}));
  EXPECT_EQ(exploration.stop_reason(), "budget");
  EXPECT_EQ(exploration.conclusion().belief.palpations().size(), 46u);
  EXPECT_EQ(exploration.conclusion().belief.palpations().back().batch, 3);
}

TEST(Exploration, HasNothingToTouchWhereNothingCanBeReached) {
  const Surface tissue = plane(26, 51);
  const Access from_below{.shaft_direction = Vec3(0.0, 0.0, -1.0)};
  const Reach reach{.vertices = reachable_vertices(tissue, from_below)};
  ASSERT_TRUE(reach.vertices->empty());
  Exploration exploration(tissue, {}, {}, reach);
  EXPECT_TRUE(exploration.next().empty());
  EXPECT_EQ(exploration.stop_reason(), "nothing left to touch");
}

TEST(Exploration, AnswersTheSameUntilSomethingIsRecorded) {
  const Surface tissue = plane(26, 51);
  const Phantom phantom = disk_phantom(tissue, 0.05);
  Exploration exploration(tissue);
  const std::vector<int> first = exploration.next();
  EXPECT_EQ(exploration.next(), first);
  Random random(1);
  exploration.record(
      travel(tissue, first, std::nullopt, probe_of(phantom, random), 0.0).palpations);
  EXPECT_NE(exploration.next(), first);
}

TEST(Exploration, IsRepeatable) {
  const Surface tissue = plane(26, 51);
  const Phantom phantom = disk_phantom(tissue, 0.10);
  const auto stops = [&] {
    Exploration exploration(tissue, {},
                            {.initial = {.design = Design::Random, .seed = 7}, .batches = 4});
    Random random(3);
    run(exploration, probe_of(phantom, random));
    return exploration.conclusion().marginals;
  };
  EXPECT_TRUE(stops().mean == stops().mean);
}

TEST(Exploration, PlansTheSameWithForesightAndWithout) {
  const Surface tissue = plane(26, 51);
  const Phantom phantom = disk_phantom(tissue, 0.05);
  const FieldModel fixed{.kernel = {.length_m = 0.0033, .signal_sd = 1.0}, .noise = {.sd = 0.1}};
  const auto planned = [&](bool foresees) {
    Exploration exploration(tissue, {.field = fixed, .level = {.known = 8.0}}, {.batches = 4});
    Random random(3);
    std::vector<std::vector<int>> stops;
    std::optional<SurfacePoint> here;
    while (!exploration.next().empty()) {
      stops.push_back(exploration.next());
      if (foresees) exploration.foresee();
      EXPECT_EQ(exploration.next(), stops.back());
      std::vector<Palpation> felt =
          travel(tissue, stops.back(), here, probe_of(phantom, random), 0.0).palpations;
      here = tissue.at_vertex(stops.back().back());
      if (stops.size() == 3) felt.pop_back();  // no contact at the last stop
      exploration.record(felt);
    }
    return stops;
  };
  EXPECT_EQ(planned(true), planned(false));
}

TEST(Exploration, ConcludesNothingOfNoiseWhateverTheFieldIsGiven) {
  const Surface tissue = plane(26, 51);
  const Phantom healthy(tissue, {}, {.noise = 0.05});
  const FieldModel given{.kernel = {.length_m = 0.0033, .signal_sd = 1.0}, .noise = {.sd = 0.1}};
  for (const LevelEstimate estimate : {LevelEstimate::Edge, LevelEstimate::Range}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      Exploration exploration(tissue, {.field = given, .level = {.estimate = estimate}},
                              {.batches = 5});
      Random random(seed);
      run(exploration, probe_of(healthy, random));
      EXPECT_FALSE(exploration.conclusion().level) << seed;
    }
  }
  Exploration over_a_disk(tissue, {.field = given}, {.batches = 5});
  Random random(1);
  const Phantom disk = disk_phantom(tissue, 0.05);
  run(over_a_disk, probe_of(disk, random));
  EXPECT_TRUE(over_a_disk.conclusion().level);
}

// Where it read high it is touched again and again.
TEST(Exploration, SeesNoTumourInNoiseWhateverItIsTouchedFor) {
  const Surface tissue = plane(26, 51);
  const Phantom healthy(tissue, {}, {.noise = 0.05});
  for (const double undetected_m : {0.0, 0.006}) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      Exploration exploration(tissue, {},
                              {.batches = 9, .aim = {.undetected_diameter_m = undetected_m}});
      Random random(seed);
      for (auto stops = exploration.next(); !stops.empty(); stops = exploration.next()) {
        exploration.record(
            travel(tissue, stops, std::nullopt, probe_of(healthy, random), 0.0).palpations);
        EXPECT_FALSE(exploration.conclusion().level)
            << undetected_m << " " << seed << " " << exploration.batch();
      }
    }
  }
}

TEST(Exploration, SeesContrastInAThousandReadingsOfAGivenField) {
  const Surface tissue = plane(26, 51);
  Random random(3);
  FieldModel given{.kernel = {.length_m = 0.0033, .signal_sd = 1.0}};
  for (const double noise_sd : {0.1, 1e-7}) {
    given.noise.sd = noise_sd;
    Exploration exploration(tissue, {.field = given, .level = {.estimate = LevelEstimate::Range}},
                            {.batches = 0});
    exploration.take_up(bumpy_readings(tissue, 1000, random));
    EXPECT_TRUE(exploration.conclusion().level) << noise_sd;
  }
}

TEST(Exploration, FindsTheDiskAndItsLevel) {
  const Surface tissue = plane(51, 101);
  const Phantom phantom = disk_phantom(tissue, 0.05);
  Exploration exploration(tissue, {}, {.acquisition = straddle(), .batches = 9});
  Random random(2);
  run(exploration, probe_of(phantom, random));
  EXPECT_TRUE(exploration.conclusion().evidence.contrast_seen);
  EXPECT_NEAR(exploration.conclusion().level->value, 8.0, 0.3);
  double wrong = 0.0;
  for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex) {
    const bool inside =
        exploration.conclusion().marginals.mean[vertex] >= exploration.conclusion().level->value;
    if (inside != (phantom.truth()[vertex] >= 8.0)) wrong += tissue.vertex_areas()[vertex];
  }
  EXPECT_LT(wrong, 0.10 * 1.227e-4);  // a tenth of the disk's 122.7 mm2
}

TEST(Exploration, ExploresByVarianceUntilThereIsContrast) {
  const Surface tissue = plane(26, 51);
  const Phantom healthy(tissue, {}, {.noise = 0.05});
  Exploration exploration(tissue, {}, {.batches = 4});
  Random random(1);
  run(exploration, probe_of(healthy, random));
  EXPECT_FALSE(exploration.conclusion().evidence.contrast_seen);
  EXPECT_FALSE(exploration.conclusion().level.has_value());  // the range of noise is no level
  // Fifty-six touches of 25 x 50 mm, spread evenly, leave no vertex farther than about 4.5 mm from
  // one.
  for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex) {
    double nearest = 1.0;
    for (const Palpation& palpation : exploration.conclusion().belief.palpations()) {
      nearest =
          std::min(nearest, (tissue.position(palpation.where) - tissue.vertex(vertex)).norm());
    }
    EXPECT_LT(nearest, 0.0045);
  }
}

TEST(Exploration, ForgetsStopsWithoutContact) {
  const Surface tissue = plane(26, 51);
  const Phantom phantom = disk_phantom(tissue, 0.05);
  Random random(1);
  // No contact on the left half.
  const Probe half = [&](const SurfacePoint& where, const Vec3&) -> std::optional<Palpation> {
    if (tissue.position(where).x() < 0.0125) return std::nullopt;
    return phantom.touch(where, random);
  };
  Exploration exploration(tissue, {}, {.batches = 6});
  std::multiset<int> asked;
  while (!exploration.next().empty()) {
    const std::vector<int> stops = exploration.next();
    asked.insert(stops.begin(), stops.end());
    exploration.record(travel(tissue, stops, std::nullopt, half, 0.0).palpations);
  }
  for (int vertex : asked) {
    if (tissue.vertex(vertex).x() < 0.0125) {
      EXPECT_EQ(asked.count(vertex), 1u);
    }
  }
}

TEST(Exploration, StopsWhenNothingIsLeftToTouch) {
  const Surface tissue = plane(4, 5);
  const Phantom phantom = disk_phantom(tissue, 0.05);
  Exploration exploration(tissue, {},
                          {.initial = {.count = 4}, .batch = {.size = 5}, .batches = 10},
                          {.touch_once = true});
  Random random(1);
  run(exploration, probe_of(phantom, random));
  EXPECT_EQ(exploration.stop_reason(), "nothing left to touch");
  EXPECT_EQ(exploration.conclusion().belief.palpations().size(), 20u);
}

TEST(Exploration, StopsAtTheExpectedErrorThatWasAskedFor) {
  const Surface tissue = plane(26, 51);
  const Phantom phantom = disk_phantom(tissue, 0.02);
  Exploration exploration(tissue, {.level = {.known = 8.0}},
                          {.acquisition = straddle(), .batches = 40, .stop = {.error_m2 = 10e-6}});
  Random random(1);
  run(exploration, probe_of(phantom, random));
  EXPECT_EQ(exploration.stop_reason(), "expected error");
}

TEST(Exploration, TakesUpReadingsMadeElsewhere) {
  const Surface tissue = plane(26, 51);
  Random random(4);
  Exploration exploration(tissue, {}, {.batches = 3});
  exploration.take_up(bumpy_readings(tissue, 30, random));
  EXPECT_EQ(exploration.conclusion().belief.palpations().size(), 30u);
  EXPECT_EQ(exploration.next().size(), 10u);
}

TEST(Exploration, LearnsTheLagAndKeepsTheReadingsWhereTheyWereMade) {
  const Surface tissue = plane(51, 101);
  const Phantom phantom(tissue, {Disk{Vec3(0.0115, 0.030, 0.0), 0.00625}},
                        {.noise = 0.05, .lag_m = 0.0015});
  const auto wrong_mm2 = [&](const Exploration& exploration) {
    double wrong = 0.0;
    for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex) {
      const bool inside = exploration.conclusion().marginals.mean[vertex] >= 8.0;
      if (inside != (phantom.truth()[vertex] >= 8.0)) wrong += 1e6 * tissue.vertex_areas()[vertex];
    }
    return wrong;
  };
  const auto explored = [&](Learnable lag_m) {
    Exploration exploration(tissue, {.field = {.probe = {.lag_m = lag_m}}, .level = {.known = 8.0}},
                            {.acquisition = straddle(), .batches = 9});
    Random random(2);
    run(exploration, [&](const SurfacePoint& where, const Vec3& travel) {
      return std::optional(phantom.touch(where, travel, random));
    });
    return exploration;
  };
  const Exploration ignored = explored(0.0), learned = explored(kLearned), known = explored(0.0015);
  EXPECT_FALSE(ignored.conclusion().lag.has_value());
  ASSERT_TRUE(learned.conclusion().lag.has_value());
  EXPECT_NEAR(learned.conclusion().lag->value_m, 0.0015, 2.0 * learned.conclusion().lag->stddev_m);
  EXPECT_LT(learned.conclusion().lag->stddev_m, 0.0005);
  EXPECT_EQ(known.conclusion().lag->value_m, 0.0015);
  EXPECT_LT(wrong_mm2(learned), 0.6 * wrong_mm2(ignored));
  EXPECT_LT(wrong_mm2(known), 0.6 * wrong_mm2(ignored));
  const Palpation& raw = learned.conclusion().palpations[50];
  EXPECT_EQ(raw.where.barycentric.maxCoeff(), 1.0);  // a stop is a vertex
  const Vec3 shift = tissue.position(raw.where) -
                     tissue.position(learned.conclusion().belief.palpations()[50].where);
  EXPECT_NEAR((shift - learned.conclusion().lag->value_m * raw.travel).norm(), 0.0,
              2e-5);  // the lag rests at a fiftieth of a millimetre
}

/// An exploration of the disk phantom by a probe whose tip has this radius.
Exploration explored_with_tip(double tip_radius_m) {
  const Surface tissue = plane(26, 51);
  const Phantom phantom = disk_phantom(tissue, 0.02);
  Exploration exploration(tissue, {.field = {.probe = {.indenter_radius_m = tip_radius_m}}});
  Random random(1);
  run(exploration, probe_of(phantom, random));
  return exploration;
}

TEST(RoundTip, TakesTheBoundaryInWithItsBandAndItsExpectedError) {
  const Exploration sharp = explored_with_tip(0.0);
  Exploration round(sharp.surface(), {.field = {.probe = {.indenter_radius_m = 0.002}}});
  round.take_up(sharp.conclusion().palpations);
  EXPECT_FALSE(round.conclusion().tip_hides_all());
  const double share = 4.25 / 6.25;  // of the disk's outline, 2 mm farther in
  EXPECT_NEAR(round.conclusion().certainty->expected.symmetric_difference_m2() /
                  sharp.conclusion().certainty->expected.symmetric_difference_m2(),
              share, 0.1);
  EXPECT_GT(round.conclusion().certainty->half_width_m, 0.0);
}

TEST(RoundTip, WiderThanATumourSaysThatNothingIsLeftOfIt) {
  const Exploration exploration = explored_with_tip(0.009);
  EXPECT_TRUE(exploration.conclusion().tip_hides_all());
  EXPECT_EQ(exploration.conclusion().certainty->half_width_m, 0.0);
}

TEST(Travel, ReadsOnTheWayOncePerMillimetre) {
  const Surface tissue = plane(26, 51);  // 1 mm cells
  const Phantom phantom = disk_phantom(tissue, 0.0);
  Random random(1);
  const std::vector<int> stops{0, 25};  // along the border, 25 mm apart
  const Tour tour = travel(tissue, stops, std::nullopt, probe_of(phantom, random), 0.001);
  EXPECT_NEAR(tour.length_m, 0.025, 1e-12);
  ASSERT_EQ(tour.palpations.size(), 26u);
  EXPECT_EQ(tour.palpations[0].kind, TouchKind::Stop);
  EXPECT_EQ(tour.palpations[1].kind, TouchKind::Way);
  EXPECT_EQ(tour.palpations[25].kind, TouchKind::Stop);
  for (int i = 0; i < 26; ++i)
    EXPECT_NEAR(tissue.position(tour.palpations[i].where).x(), 0.001 * i, 1e-12);
  EXPECT_NEAR((tour.palpations[7].travel - Vec3::UnitX()).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace palpation
