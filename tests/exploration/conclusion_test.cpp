// What follows from readings follows from them alone.
#include "palpation/exploration/conclusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "belief/tissue.h"
#include "exploration/search_goal.h"
#include "palpation/base/error.h"
#include "palpation/boundary/level_set.h"
#include "palpation/exploration/exploration.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/world/phantom.h"

namespace palpation {
namespace {

Probe probe_over(const Phantom& phantom, Random& random) {
  return [&](const SurfacePoint& where, const Vec3& travel) {
    return std::optional(phantom.touch(where, travel, random));
  };
}

Phantom disk(const Surface& tissue) {
  return Phantom(tissue, {Disk{Vec3(0.0115, 0.030, 0.0), 0.00625}}, {.noise = 0.05});
}

std::vector<Model> models() {
  const KernelModel given{.length_m = 0.0033, .signal_sd = 1.0};
  return {Model{},
          Model{.field = {.economy = {.rebuild_gain = 0.5}}},
          Model{.field = {.kernel = given, .noise = {.sd = 0.1}}},
          Model{.field = {.trend = {.is_linear = true}}},
          Model{.field = {.probe = {.lag_m = kLearned, .screening = true}}},
          Model{.field = {.probe = {.indenter_radius_m = 0.001}}}};
}

void expect_same_bytes(const Conclusion& a, const Conclusion& b) {
  EXPECT_TRUE(a.marginals.mean == b.marginals.mean);
  EXPECT_TRUE(a.marginals.variance == b.marginals.variance);
  ASSERT_EQ(a.contour.has_value(), b.contour.has_value());
  if (a.contour) {
    EXPECT_TRUE(a.contour->field == b.contour->field);
    EXPECT_EQ(a.contour->level, b.contour->level);
  }
  ASSERT_EQ(a.certainty.has_value(), b.certainty.has_value());
  if (a.certainty) {
    EXPECT_TRUE(a.certainty->score == b.certainty->score);
  }
}

// Where the field followed noise, the noise that outlines tell counts for what could hide.
TEST(Conclude, NoiseThatOutlinesTellLetsMoreHide) {
  const Surface tissue = plane(26, 51);
  const Phantom phantom = disk(tissue);
  Random random(4);
  Exploration exploration(tissue, Model{}, {.batches = 6});
  run(exploration, probe_over(phantom, random));
  Conclusion conclusion = conclude(tissue, Model{}, exploration.readings(), nullptr, 1);
  ASSERT_TRUE(conclusion.outlines);
  EXPECT_NEAR(conclusion.outlines->noise, 1.0, 0.3);
  conclusion.outlines->noise = 1.0;
  const double before = diameter_ruled_out_m(conclusion, 0.95).value();
  conclusion.outlines->noise = 0.5;
  EXPECT_EQ(diameter_ruled_out_m(conclusion, 0.95).value(), before);
  conclusion.outlines->noise = 4.0;
  EXPECT_GT(diameter_ruled_out_m(conclusion, 0.95).value(), 1.1 * before);
}

// Readings that scatter four times as much on the tumour as beside it, and ones that do not.
TEST(Conclude, ThatReadingsScatterMoreOnATumourIsLearned) {
  const Surface tissue = plane(26, 51);
  const Phantom phantom(tissue, {Disk{Vec3(0.0125, 0.028, 0.0), 0.0095}}, {.noise = 0.0});
  for (const double times : {1.0, 4.0}) {
    Random random(6);
    std::vector<Palpation> readings;
    for (int i = 0; i < 150; ++i) {
      Palpation reading = phantom.touch(
          tissue.project(Vec3(0.025 * random.uniform(), 0.050 * random.uniform(), 0.0)), random);
      const double share = 0.5 * (reading.reading - 7.0);
      reading.reading += 0.06 * std::pow(times, share) * random.normal();
      readings.push_back(reading);
    }
    const Conclusion conclusion = conclude(tissue, Model{}, readings, nullptr, 1);
    ASSERT_TRUE(conclusion.outlines) << times;
    const DrawnNumber& inside = conclusion.outlines->noise_inside;
    EXPECT_LT(inside.least, times + 0.1);
    EXPECT_GT(inside.most, times);
    EXPECT_EQ(inside.least > 1.1, times > 1.1);
  }
}

// Seven standard deviations above healthy tissue, where nothing else stands out.
TEST(Conclude, AReadingThatFitsNoOutlineIsToldToCountForNothing) {
  const Surface tissue = plane(26, 51);
  const Phantom phantom = disk(tissue);
  Random random(7);
  std::vector<Palpation> readings;
  for (int i = 0; i < 120; ++i)
    readings.push_back(phantom.touch(
        tissue.project(Vec3(0.025 * random.uniform(), 0.050 * random.uniform(), 0.0)), random));
  const Vec3 place(0.019, 0.012, 0.0);
  readings.push_back({.where = tissue.project(place), .reading = 7.7});
  const Conclusion conclusion = conclude(tissue, Model{}, readings, nullptr, 1);
  ASSERT_TRUE(conclusion.outlines);
  ASSERT_EQ(conclusion.outlines->misfit.unheeded.size(), 1U);
  EXPECT_LT((tissue.position(conclusion.outlines->misfit.unheeded.front()) - place).norm(), 1e-9);
}

// A core of 4.5 mm in a rim half as stiff, felt all over. One line half way up to the core would
// lie on the rim, and be anything.
TEST(Conclude, ATumourOfTwoHeightsIsOneOutline) {
  Random random(8);
  const Surface tissue(make_plane({.size_m = Vec2(0.05, 0.05), .columns = 51, .rows = 51}, random));
  PhantomDesign design;
  design.lumps.resize(2);
  design.lumps[0].outline = Disk{Vec3(0.025, 0.025, 0.0), 0.009};
  design.lumps[0].contrast = 0.5;
  design.lumps[1].outline = Disk{Vec3(0.026, 0.025, 0.0), 0.0045};
  design.model.noise = 0.03;
  const Phantom phantom(tissue, design);
  std::vector<Palpation> readings;
  for (int i = 0; i < 300; ++i)
    readings.push_back(phantom.touch(
        tissue.project(Vec3(0.05 * random.uniform(), 0.05 * random.uniform(), 0.0)), random));
  const Conclusion conclusion = conclude(tissue, Model{}, readings, nullptr, 1);
  ASSERT_TRUE(conclusion.outlines && conclusion.outlines->core);
  const DrawnCore& core = *conclusion.outlines->core;
  EXPECT_EQ(core.probability, 1.0);
  EXPECT_LE(core.beside.least, 0.5);
  EXPECT_GE(core.beside.most, 0.5);
  EXPECT_LT((tissue.position(core.where) - Vec3(0.026, 0.025, 0.0)).norm(), 0.0015);
  EXPECT_LE(conclusion.outlines->area_m2.least, 254e-6);
  EXPECT_GE(conclusion.outlines->area_m2.most, 254e-6);
}

// As a phantom without a tip feels it: nothing is between the plateaus, and they have no noise.
TEST(Conclude, AStepWithoutNoiseIsFound) {
  constexpr double kRadius_m = 0.005, kArea_m2 = std::numbers::pi * kRadius_m * kRadius_m;
  Random random(2);
  const Surface tissue(make_plane({.size_m = Vec2(0.02, 0.03), .columns = 41, .rows = 61}, random));
  std::vector<Palpation> readings;
  for (int i = 0; i < 150; ++i) {
    const Vec3 place(0.02 * random.uniform(), 0.03 * random.uniform(), 0.0);
    const bool is_inside = (place - Vec3(0.011, 0.017, 0.0)).norm() < kRadius_m;
    readings.push_back({.where = tissue.project(place), .reading = is_inside ? 1.0 : 0.0});
  }
  const Conclusion conclusion = conclude(tissue, Model{}, readings, nullptr, 1);
  ASSERT_TRUE(conclusion.contour && conclusion.outlines);
  EXPECT_NEAR(superlevel_area(tissue, conclusion.contour->field, conclusion.contour->level),
              kArea_m2, 0.1 * kArea_m2);
  EXPECT_LT(conclusion.outlines->expected.missed_m2 + conclusion.outlines->expected.extra_m2,
            0.2 * kArea_m2);
}

// Twenty readings of healthy tissue whose noise has heavy tails: they gather on two plateaus, but
// the edge between those is nowhere. The middle of the field's range would part noise from noise.
TEST(Conclude, NoiseThatNoEdgePartsIsNoTumour) {
  constexpr double kReadings[][3] = {
      {8.9905, 18.6674, 7.04418},  {21.5895, 22.0198, 7.04696}, {32.5872, 8.0781, 7.02626},
      {25.8700, 15.4194, 7.00876}, {18.7425, 3.0746, 7.04456},  {37.5262, 3.8617, 7.00243},
      {35.8004, 12.3585, 7.01369}, {30.1019, 35.0433, 7.0013},  {38.7536, 18.9215, 6.98881},
      {27.9162, 21.9947, 7.03207}, {31.8128, 26.5598, 6.99715}, {12.6050, 37.4660, 7.0071},
      {10.6527, 18.1604, 7.00289}, {33.4997, 7.3823, 7.11441},  {28.5720, 6.2959, 7.01432},
      {21.8727, 37.4923, 7.01169}, {7.2673, 8.1248, 7.023},     {19.2516, 39.6650, 7.0153},
      {38.1178, 28.4424, 6.99455}, {23.8515, 31.2487, 7.03873}};
  Random random(1);
  const Surface tissue(make_plane({.size_m = Vec2(0.04, 0.04), .columns = 81, .rows = 81}, random));
  std::vector<Palpation> readings;
  for (const auto& [x, y, reading] : kReadings)
    readings.push_back(
        {.where = tissue.project(Vec3(0.001 * x, 0.001 * y, 0.0)), .reading = reading});
  const Conclusion conclusion = conclude(tissue, Model{}, readings, nullptr, 1);
  EXPECT_TRUE(conclusion.evidence.contrast_seen);
  EXPECT_FALSE(conclusion.level);
  EXPECT_FALSE(conclusion.contour);
}

// Batch after batch with what was kept of the batches before, and once from all the readings.
TEST(Conclude, IsTheSameWithACacheAndWithout) {
  const Surface tissue = plane(26, 51);
  const Phantom phantom = disk(tissue);
  for (const Model& model : models()) {
    Random random(3);
    Exploration exploration(tissue, model, {.batches = 4});
    run(exploration, probe_over(phantom, random), [&](const Tour&) {
      const Conclusion anew = conclude(tissue, model, exploration.readings());
      expect_same_bytes(exploration.conclusion(), anew);
    });
  }
}

// The rule that looks back at earlier batches included.
TEST(Choose, PlansTheSameFromAllReadingsAtOnce) {
  const Surface tissue = plane(26, 51);
  const Phantom phantom = disk(tissue);
  Random random(3);
  const Plan plan{.batches = 20, .stop = {.least_gain = 0.3}};
  Exploration exploration(tissue, {}, plan);
  const auto expect_same_plan = [&] {
    Exploration other(tissue, {}, plan);
    other.take_up(exploration.readings());
    EXPECT_EQ(other.next(), exploration.next());
    EXPECT_EQ(other.stop_reason(), exploration.stop_reason());
  };
  run(exploration, probe_over(phantom, random), [&](const Tour&) { expect_same_plan(); });
  EXPECT_EQ(exploration.stop_reason(), "nothing to gain");
}

// Batches count as they come, whatever they are called.
TEST(Choose, LooksBackAtBatchesWhateverTheirNumbersAre) {
  const Surface tissue = plane(26, 51);
  const Phantom phantom = disk(tissue);
  Random random(3);
  const Plan plan{.batches = 4, .stop = {.least_gain = 0.3}};
  Exploration exploration(tissue, {}, plan);
  run(exploration, probe_over(phantom, random), [](const Tour&) {});
  std::vector<Palpation> readings = exploration.readings();
  const auto errors_of = [&](const std::vector<Palpation>& all) {
    return progress_of(tissue, conclude(tissue, {}, all), plan, all).expected_errors_m2;
  };
  const std::vector<double> in_turn = errors_of(readings);
  EXPECT_GT(in_turn.size(), 2u);
  for (Palpation& one : readings) one.batch *= 100'000;
  EXPECT_EQ(errors_of(readings), in_turn);
}

// A reading that is no number is refused, as often as it is offered, and costs nothing.
TEST(Exploration, RecordsAWholeStepOrNothing) {
  const Surface tissue = plane(11, 21);
  const Phantom phantom = disk(tissue);
  Random random(3);
  Exploration exploration(tissue, {}, {.batches = 3});
  const std::vector<int> stops = exploration.next();
  std::vector<Palpation> felt =
      travel(tissue, stops, {}, probe_over(phantom, random), 0.0).palpations;
  std::vector<Palpation> wrong = {felt.front()};
  wrong.front().reading = std::numeric_limits<double>::quiet_NaN();
  for (int time = 0; time < 3; ++time) {
    EXPECT_THROW(exploration.record(wrong), InvalidInput);
    EXPECT_EQ(exploration.batch(), 0);
    EXPECT_EQ(exploration.next(), stops);
    EXPECT_TRUE(exploration.readings().empty());
  }
  exploration.record(felt);
  EXPECT_EQ(exploration.batch(), 1);
  EXPECT_EQ(exploration.readings().size(), stops.size());
}

// Stops without contact are told as such, count as a batch, and are not planned again.
TEST(Exploration, KeepsWhatCouldNotBeTouched) {
  const Surface tissue = plane(11, 21);
  Exploration exploration(tissue, {}, {.batches = 3});
  const std::vector<int> stops = exploration.next();
  exploration.record({});
  EXPECT_EQ(exploration.batch(), 1);
  EXPECT_TRUE(exploration.conclusion().palpations.empty());
  ASSERT_EQ(exploration.readings().size(), stops.size());
  for (const Palpation& one : exploration.readings()) EXPECT_EQ(one.kind, TouchKind::Missed);
  for (const int vertex : exploration.next())
    EXPECT_EQ(std::count(stops.begin(), stops.end(), vertex), 0);
}

}  // namespace
}  // namespace palpation
