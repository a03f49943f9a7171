// Explorations of tilted tissue.
#include <gtest/gtest.h>

#include "belief/tissue.h"
#include "palpation/exploration/exploration.h"
#include "palpation/world/phantom.h"

namespace palpation {
namespace {

Exploration explored(const Surface& tissue, const Phantom& phantom, const FieldModel& field,
                     const LevelRule& level, int batches) {
  Exploration exploration(tissue, {.field = field, .level = level},
                          {.acquisition = straddle(), .batches = batches});
  Random random(1);
  run(exploration, [&](const SurfacePoint& where, const Vec3&) {
    return std::optional(phantom.touch(where, random));
  });
  return exploration;
}

double wrong_mm2(const Exploration& exploration, const Phantom& phantom) {
  double wrong = 0.0;
  for (int vertex = 0; vertex < exploration.surface().vertex_count(); ++vertex) {
    const bool inside =
        exploration.conclusion().component.mean[vertex] >= exploration.conclusion().level->value;
    if (inside != (phantom.truth()[vertex] >= phantom.true_level()))
      wrong += 1e6 * exploration.surface().vertex_areas()[vertex];
  }
  return wrong;
}

Phantom tilted_disk(const Surface& tissue, double bias) {
  return Phantom(tissue, {Disk{Vec3(0.0115, 0.030, 0.0), 0.00625}}, {.noise = 0.01, .bias = bias});
}

// The tilt adds as much from end to end as the tumour does. The outline passes 39 cells of 1 mm2: a
// third of these may be judged wrong. Without the trend the level of the range takes much of one
// end for tumour; that of the edge finds that there is one.
TEST(Trend, IsTakenOutOfLevelAndBoundary) {
  const Surface tissue = plane(26, 51);
  for (const LevelEstimate estimate : {LevelEstimate::Edge, LevelEstimate::Range}) {
    const LevelRule level{.estimate = estimate};
    const Phantom tilted = tilted_disk(tissue, 1.0);
    EXPECT_LT(wrong_mm2(explored(tissue, tilted, {.trend = {.is_linear = true}}, level, 6), tilted),
              13.0);
    const Exploration without = explored(tissue, tilted, {}, level, 6);
    if (estimate == LevelEstimate::Range) {
      EXPECT_GT(wrong_mm2(without, tilted), 100.0);
    } else {
      EXPECT_LT(wrong_mm2(without, tilted), 13.0);
    }
  }
}

TEST(Trend, ServesFieldsOfFixedHyperparametersToo) {
  const Surface tissue = plane(26, 51);
  const FieldModel field{.kernel = {.length_m = 0.0035, .signal_sd = 1.0},
                         .trend = {.is_linear = true},
                         .noise = {.sd = 0.05}};
  const Phantom tilted = tilted_disk(tissue, 1.0);
  EXPECT_LT(
      wrong_mm2(explored(tissue, tilted, field, {.estimate = LevelEstimate::Edge}, 6), tilted),
      13.0);
}

TEST(Trend, IsNoTumour) {
  const Surface tissue = plane(26, 51);
  const Phantom healthy(tissue, {}, {.noise = 0.05, .bias = 1.0});
  EXPECT_FALSE(explored(tissue, healthy, {.trend = {.is_linear = true}}, {}, 4)
                   .conclusion()
                   .evidence.contrast_seen);
  EXPECT_FALSE(explored(tissue, healthy, {}, {}, 4).conclusion().evidence.contrast_seen);
  EXPECT_TRUE(explored(tissue, healthy, {}, {.estimate = LevelEstimate::Range}, 4)
                  .conclusion()
                  .evidence.contrast_seen);
}

TEST(Trend, LeavesAllOpenWhileFewPlacesAreTouched) {
  const Surface tissue = plane(26, 51);
  Random random(4);
  const std::vector<Palpation> readings = bumpy_readings(tissue, 15, random);
  Exploration exploration(
      tissue, {.field = {.trend = {.is_linear = true}}, .contrast = {.safe_start = false}},
      {.batches = 3});
  exploration.take_up(std::span(readings).first(14));
  EXPECT_TRUE(exploration.conclusion().evidence.trend_is_missing);
  EXPECT_FALSE(exploration.conclusion().level.has_value());
  exploration.take_up(std::span(readings).last(1));
  EXPECT_FALSE(exploration.conclusion().evidence.trend_is_missing);
  EXPECT_TRUE(exploration.conclusion().level.has_value());
}

TEST(Trend, LeavesTheWholeFieldToItsMarginals) {
  const Surface tissue = plane(26, 51);
  const Phantom tilted = tilted_disk(tissue, 1.0);
  const Exploration with = explored(tissue, tilted, {.trend = {.is_linear = true}}, {}, 3),
                    without = explored(tissue, tilted, {}, {}, 3);
  EXPECT_TRUE(with.conclusion().component.variance == with.conclusion().marginals.variance);
  // What is taken out is the slope: 2 over 50 mm, known to a quarter from so few readings around a
  // tumour.
  const Eigen::VectorXd out = with.conclusion().marginals.mean - with.conclusion().component.mean;
  EXPECT_NEAR(out.maxCoeff() - out.minCoeff(), 2.0, 0.5);
  EXPECT_TRUE(without.conclusion().component.mean == without.conclusion().marginals.mean);
  EXPECT_TRUE(without.conclusion().component.variance == without.conclusion().marginals.variance);
}

}  // namespace
}  // namespace palpation
