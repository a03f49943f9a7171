// Readings on the way.
#include <gtest/gtest.h>

#include "belief/tissue.h"
#include "palpation/exploration/exploration.h"
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

}  // namespace
}  // namespace palpation
