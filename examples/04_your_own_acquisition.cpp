// A criterion of your own, beside the published ones: chosen in batches, lazily, with the variance
// that each pick will remove. Usage: 04_your_own_acquisition
#include <cmath>
#include <cstdio>

#include "palpation/palpation.h"

using namespace palpation;

int main() {
  Random random(1);
  const Surface tissue(make_plane({.columns = 51, .rows = 101}, random));
  const Phantom phantom(
      tissue,
      {Horseshoe{
          .centre_m = Vec3(0.0095, 0.020, 0.0), .arc_radius_m = 0.007, .half_width_m = 0.0025}},
      {.noise = 0.05});
  const Region truth = superlevel_region(tissue, phantom.truth(), phantom.true_level());

  // Worth most where the level is near in standard deviations, and the standard deviation is large.
  const Acquisition mine = Pointwise{.score =
                                         [](double mean, double stddev, const Level& level) {
                                           const double z = (mean - level.value) / stddev;
                                           return stddev * std::exp(-0.5 * z * z);
                                         },
                                     .grows_with_stddev = true};
  for (const auto& [name, acquisition] :
       {std::pair{"evr", Acquisition(evr())}, std::pair{"straddle", Acquisition(straddle())},
        std::pair{"mine", mine}}) {
    Exploration exploration(tissue, {.level = {.known = 8.0}}, {.acquisition = acquisition});
    Random noise(2);
    run(exploration, [&](const SurfacePoint& where, const Vec3&) {
      return std::optional(phantom.touch(where, noise));
    });
    const Region found = superlevel_region(tissue, exploration.conclusion().marginals.mean, 8.0);
    std::printf("%-8s %.1f mm2 wrong\n", name,
                compare(tissue, found, truth).symmetric_difference_m2 * 1e6);
  }
}
