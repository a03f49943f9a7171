#include "palpation/certainty/reference_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kSearchArea_m2 = 12.5e-4;
constexpr double kDisk_m = 2.0 * std::numbers::pi * 0.00625;
/// Arcs of 9.5 and 4.5 mm, and two caps of 2.5 mm.
constexpr double kHorseshoe_m = std::numbers::pi * (0.0095 + 0.0045 + 2.0 * 0.0025);

double percent(double perimeter_m, double noise, bool plateaus_known) {
  return 100.0 / kSearchArea_m2 *
         reference_bound(
             {.perimeter_m = perimeter_m, .noise = noise, .plateaus_known = plateaus_known})
             .expected_error_m2;
}

// The published simulations' disk and horseshoe, 105 readings at 1, 5, 10 and 25 % noise: worked
// out by an independent program.
TEST(ReferenceBound, IsThatOfThePublishedShapes) {
  const std::vector<double> noises = {0.01, 0.05, 0.10, 0.25};
  const std::vector<double> unknown_disk = {.028, .140, .280, .699},
                            unknown_horseshoe = {.049, .245, .490, 1.224};
  const std::vector<double> known_disk = {.021, .105, .210, .524},
                            known_horseshoe = {.038, .192, .383, .958};
  for (std::size_t i = 0; i < noises.size(); ++i) {
    EXPECT_NEAR(percent(kDisk_m, noises[i], false), unknown_disk[i], 0.0005 + 1e-6);
    EXPECT_NEAR(percent(kHorseshoe_m, noises[i], false), unknown_horseshoe[i], 0.0005 + 1e-6);
    EXPECT_NEAR(percent(kDisk_m, noises[i], true), known_disk[i], 0.0005 + 1e-6);
    EXPECT_NEAR(percent(kHorseshoe_m, noises[i], true), known_horseshoe[i], 0.0005 + 1e-6);
  }
}

TEST(ReferenceBound, CountsAModeForEveryFourAndAHalfMillimetres) {
  EXPECT_EQ(reference_bound({.perimeter_m = kDisk_m}).modes, 9);
  EXPECT_EQ(reference_bound({.perimeter_m = kHorseshoe_m}).modes, 13);
  EXPECT_EQ(reference_bound({.perimeter_m = 0.001}).modes, 1);
}

// The twin: every split of the readings between boundary and plateaus, of which the best is taken.
// Boundary readings tell P offsets of the line y = level, plateau readings the level, which is
// common to all.
TEST(ReferenceBound, SpendsReadingsWhereTheyTellMost) {
  const int readings = 1000;
  for (const double fraction : {0.5, 0.7}) {
    const ReferenceBound bound = reference_bound(
        {.perimeter_m = kDisk_m, .noise = 0.1, .readings = readings, .fraction = fraction});
    double best = INFINITY;
    for (int on_plateaus = 1; on_plateaus < readings; ++on_plateaus) {
      for (int on_low = 1; on_low < on_plateaus; on_low += 3) {
        const double level =
            (1 - fraction) * (1 - fraction) / on_low + fraction * fraction / (on_plateaus - on_low);
        best = std::min(best, 9.0 / (readings - on_plateaus) + level);
      }
    }
    EXPECT_NEAR(bound.offset_sd_m, 0.1 / (1400.0 * fraction * (1 - fraction)) * std::sqrt(best),
                2e-3 * bound.offset_sd_m);  // in twentieths
  }
}

// Of one mode the band is the normal's 1.96; of nine, P(all within 2.766) = 0.99432^9 = 0.95.
TEST(ReferenceBound, HoldsAllModesInItsBandAtOnce) {
  const ReferenceBound one = reference_bound({.perimeter_m = 0.004});
  EXPECT_NEAR(one.band_half_width_m() / one.offset_sd_m, 1.959964, 1e-6);
  const ReferenceBound nine = reference_bound({.perimeter_m = kDisk_m});
  const double z = nine.band_half_width_m() / nine.offset_sd_m;
  EXPECT_NEAR(std::pow(std::erf(z / std::sqrt(2.0)), 9.0), 0.95, 1e-12);
  EXPECT_NEAR(z, 2.766, 1e-3);
}

TEST(ReferenceBound, RefusesWhatIsNoCase) {
  EXPECT_THROW(reference_bound({}), InvalidInput);
  EXPECT_THROW(reference_bound({.perimeter_m = 0.01, .slope_per_m = 0.0}), InvalidInput);
  EXPECT_THROW(reference_bound({.perimeter_m = 0.01, .noise = -1.0}), InvalidInput);
  EXPECT_THROW(reference_bound({.perimeter_m = 0.01, .readings = 0}), InvalidInput);
  EXPECT_THROW(reference_bound({.perimeter_m = 0.01, .fraction = 1.0}), InvalidInput);
  EXPECT_THROW(reference_bound({.perimeter_m = 0.01}).band_half_width_m(1.0), InvalidInput);
}

}  // namespace
}  // namespace palpation
