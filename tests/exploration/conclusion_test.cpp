// What follows from readings follows from them alone.
#include "palpation/exploration/conclusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "belief/tissue.h"
#include "palpation/base/error.h"
#include "palpation/exploration/exploration.h"
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
          Model{.field = {.noise = {.heavy_tails = true}}},
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
