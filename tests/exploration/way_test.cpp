// Readings on the way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "belief/tissue.h"
#include "exploration/field_fit.h"
#include "palpation/exploration/exploration.h"
#include "palpation/readings/screening.h"
#include "palpation/world/phantom.h"

namespace palpation {
namespace {

/// One exploration of a disk, its probe reading on the way or not.
double wrong_mm2(double way_step_m) {
  const Surface tissue = plane(26, 51);
  const Phantom phantom(tissue, {Disk{Vec3(0.0115, 0.030, 0.0), 0.00625}}, {.noise = 0.25});
  Random random(1);
  Exploration exploration(
      tissue, {},
      {.acquisition = straddle(), .batch = {.way_reading_m = way_step_m}, .batches = 4});
  const Probe probe = [&](const SurfacePoint& where, const Vec3&) {
    return std::optional(phantom.touch(where, random));
  };
  run(exploration, probe, {}, way_step_m);
  double wrong = 0.0;
  for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex) {
    const bool inside =
        exploration.conclusion().component.mean[vertex] >= exploration.conclusion().level->value;
    if (inside != (phantom.truth()[vertex] >= 8.0)) wrong += 1e6 * tissue.vertex_areas()[vertex];
  }
  return wrong;
}

// 56 stops at 25 % noise leave the disk with a ragged edge; some 300 readings more smooth it.
TEST(ReadingsOnTheWay, HelpWhereNoiseIsGreat) { EXPECT_LT(wrong_mm2(0.001), 0.8 * wrong_mm2(0.0)); }

/// How deep a place lies in a square of 9 mm.
double depth_in_square(const Vec3& place) {
  const Vec2 off = (place.head<2>() - Vec2(0.0125, 0.0125)).cwiseAbs().array() - 0.0045;
  return -off.cwiseMax(0.0).norm() - std::min(off.maxCoeff(), 0.0);
}

/// Row by row, one reading a millimetre.
std::vector<Palpation> slides_over_square(const Surface& surface) {
  Random random(4);
  std::vector<Palpation> slides;
  for (int row = 0; row < 19; ++row) {
    for (int i = 0; i < 19; ++i) {
      const Vec3 place(0.0036 + 0.00098 * i, 0.0034 + 0.001 * row, 0.0);
      slides.push_back({.where = surface.project(place),
                        .reading = 7.0 + 2.0 / (1.0 + std::exp(-1400.0 * depth_in_square(place))) +
                                   0.02 * random.normal(),
                        .kind = TouchKind::Way,
                        .travel = Vec3::UnitX()});
    }
  }
  return slides;
}

// The field takes two for one in their middle. Across an edge, and around a corner, that is not
// what lies there: by those means the outline passes the corners 0.1 to 0.2 mm inside.
TEST(ReadingsOnTheWay, AreKnownOneByOneToOutlines) {
  const Surface surface = plane(51, 51);
  const std::vector<Palpation> slides = slides_over_square(surface);
  const Conclusion conclusion =
      conclude(surface, {.level = {.estimate = LevelEstimate::Edge}}, slides, nullptr, 1);
  ASSERT_LT(conclusion.belief.palpations().size(), 0.7 * static_cast<double>(slides.size()));
  ASSERT_TRUE(conclusion.outlines);
  for (const double x : {-0.0045, 0.0045}) {
    for (const double y : {-0.0045, 0.0045}) {
      const SurfacePoint corner = surface.project(Vec3(0.0125 + x, 0.0125 + y, 0.0));
      EXPECT_GT(surface.interpolate(conclusion.outlines->depth, corner), -0.00007);
    }
  }
}

// A sensor that hung for a while leaves many that tell nothing; those that are left are as many as
// are learned from.
TEST(ReadingsOnTheWay, TeachHoweverManyOthersAreSetAside) {
  const Surface surface = plane(51, 51);
  std::vector<Palpation> slides = slides_over_square(surface);
  for (std::size_t i = 0; i < kMostToLearnFrom + 10; ++i) slides[i].set_aside = kOutlier;
  const LearnedField taught = learn_field(surface, {}, slides);
  EXPECT_TRUE(taught.taught);
  EXPECT_LT(taught.learned.noise_sd, 0.2);
}

}  // namespace
}  // namespace palpation
