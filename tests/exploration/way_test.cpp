// Readings on the way.
#include <gtest/gtest.h>

#include "belief/tissue.h"
#include "exploration/field_fit.h"
#include "palpation/world/phantom.h"

namespace palpation {
namespace {

Palpation on_the_way(const Surface& tissue, const Vec3& place, const Vec3& travel, double reading) {
  Palpation palpation;
  palpation.where = tissue.project(place);
  palpation.kind = TouchKind::Way;
  palpation.travel = travel;
  palpation.reading = reading;
  return palpation;
}

TEST(MergedOnTheWay, PutsNeighboursInTheirMiddleWithTheirPrecisionsAddedUp) {
  const Surface tissue = plane(26, 51);
  std::vector<Palpation> palpations;
  for (int i = 0; i < 5; ++i) palpations.push_back(on_the_way(tissue, {0.010 + 0.001 * i, 0.02, 0.0}, Vec3::UnitX(), 7.0 + i));
  palpations[3].noise_variance = 0.02;
  palpations.push_back(touch(tissue, 400, 8.0));                                        // a stop stays
  palpations.push_back(on_the_way(tissue, {0.0146, 0.02, 0.0}, Vec3::UnitX(), 1.0));    // so does what comes after it
  palpations.push_back(on_the_way(tissue, {0.0146, 0.0205, 0.0}, Vec3::UnitY(), 2.0));  // and what goes another way
  const std::vector<Palpation> merged = merged_on_the_way(tissue, palpations, 0.00105, 0.01);
  ASSERT_EQ(merged.size(), 6u);
  EXPECT_NEAR(merged[0].reading, 7.5, 1e-12);
  EXPECT_NEAR(merged[0].noise_variance, 0.005, 1e-12);
  EXPECT_NEAR(tissue.position(merged[0].where).x(), 0.0105, 1e-12);
  EXPECT_NEAR(merged[1].reading, (9.0 / 0.01 + 10.0 / 0.02) / 150.0, 1e-12);  // twice the noise counts half
  EXPECT_NEAR(tissue.position(merged[1].where).x(), 0.012 + 0.001 / 3.0, 1e-12);
  EXPECT_EQ(merged[2].reading, 11.0);
  EXPECT_EQ(merged[3].reading, 8.0);
  EXPECT_EQ(merged[4].reading, 1.0);
  EXPECT_EQ(merged[5].reading, 2.0);
}

TEST(MergedOnTheWay, LeavesReadingsWithoutNoiseApart) {
  const Surface tissue = plane(26, 51);
  const std::vector<Palpation> two{on_the_way(tissue, {0.010, 0.02, 0.0}, Vec3::UnitX(), 7.0),
                                   on_the_way(tissue, {0.011, 0.02, 0.0}, Vec3::UnitX(), 8.0)};
  EXPECT_EQ(merged_on_the_way(tissue, two, 0.00105, 0.0).size(), 2u);
}

/// One exploration of a disk, its probe reading on the way or not.
double wrong_mm2(double way_step_m) {
  const Surface tissue = plane(26, 51);
  const Phantom phantom(tissue, {Disk{Vec3(0.0115, 0.030, 0.0), 0.00625}}, {.noise = 0.25});
  Random random(1);
  Exploration exploration(tissue, {}, {}, {.acquisition = straddle(), .batch = {.way_reading_m = way_step_m}, .batches = 4}, 1);
  const Probe probe = [&](const SurfacePoint& where, const Vec3&) { return std::optional(phantom.touch(where, random)); };
  run(exploration, probe, {}, way_step_m);
  double wrong = 0.0;
  for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex) {
    const bool inside = exploration.component().mean[vertex] >= exploration.level()->value;
    if (inside != (phantom.truth()[vertex] >= 8.0)) wrong += 1e6 * tissue.vertex_areas()[vertex];
  }
  return wrong;
}

// 56 stops at 25 % noise leave the disk with a ragged edge; some 300 readings more smooth it.
TEST(ReadingsOnTheWay, HelpWhereNoiseIsGreat) { EXPECT_LT(wrong_mm2(0.001), 0.8 * wrong_mm2(0.0)); }

}  // namespace
}  // namespace palpation
