// Finds a simulated tumour in ten lines: where to touch, what was felt, where it ends.
// Usage: 01_find_a_tumour
#include <cstdio>

#include "palpation/palpation.h"

using namespace palpation;

int main() {
  Random random(1);
  const Surface tissue(
      make_plane({.size_m = Vec2(0.025, 0.050), .columns = 51, .rows = 101}, random));
  const Phantom phantom(tissue, {Disk{.centre_m = Vec3(0.0115, 0.030, 0.0), .radius_m = 0.00625}},
                        {.noise = 0.05});

  Exploration exploration(tissue);
  run(exploration, [&](const SurfacePoint& where, const Vec3&) {
    return std::optional(phantom.touch(where, random));
  });

  const Region tumour = superlevel_region(tissue, exploration.conclusion().contour->field,
                                          exploration.conclusion().contour->level);
  const Region truth = superlevel_region(tissue, phantom.truth(), phantom.true_level());
  const RegionError error = compare(tissue, tumour, truth);
  std::printf("%zu touches, %.0f mm2 found, %.0f mm2 true, %.1f %% of the search area wrong\n",
              exploration.conclusion().belief.palpations().size(), tumour.area() * 1e6,
              truth.area() * 1e6, 100.0 * error.symmetric_difference_m2 / tissue.area());
}
