#include "exploration/comparable_evidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "palpation/base/random.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

/// A disk of 9 in 7, felt once at each of some vertices, and again there or `apart` vertices on;
/// readings in a unit so many times as fine.
Belief felt_twice(const Surface& surface, int apart, double times) {
  Random random(5);
  std::vector<Palpation> palpations;
  for (int batch = 0; batch < 2; ++batch) {
    for (int vertex = 0; vertex + apart < surface.vertex_count(); vertex += 9) {
      const double depth = 0.006 - (surface.vertex(vertex) - Vec3(0.0125, 0.0125, 0.0)).norm();
      const double reading = 7.0 + 2.0 / (1.0 + std::exp(-1400.0 * depth)) + 0.1 * random.normal();
      palpations.push_back({.where = surface.at_vertex(vertex + batch * apart),
                            .reading = times * reading,
                            .batch = batch});
    }
  }
  const Prior prior(surface, Metric::Chart, Kernel{.length_m = 0.0045, .signal_sd = times});
  return Belief(prior, {.noise_sd = 0.1 * times}).condition_on(palpations);
}

double evidence_of(const Belief& belief, double times) {
  const double first_levels[] = {8.0 * times};
  return comparable_evidence(EdgeBelief::around(belief, belief.at_vertices(), first_levels, 0.5),
                             belief, belief.noise_variance());
}

TEST(ComparableEvidence, OfReadingsThatAreKnownTogetherOrApartIsAsFarApartInAnyUnit) {
  Random random(0);
  const Surface surface(make_plane({.size_m = {0.025, 0.025}, .columns = 26, .rows = 26}, random));
  const auto gain = [&](double times) {
    const Belief together = felt_twice(surface, 0, times), apart = felt_twice(surface, 1, times);
    EXPECT_GT(apart.site_count(), 1.9 * together.site_count());
    return evidence_of(together, times) - evidence_of(apart, times);
  };
  EXPECT_NEAR(gain(1.0), gain(1e6), 1e-4);
  EXPECT_GT(gain(1.0), 5.0);  // the second half was felt a millimetre from where it is said to be
}

TEST(ComparableEvidence, CountsForAGainTheRowsThatWereFeltSince) {
  Random random(0);
  const Surface surface(make_plane({.size_m = {0.025, 0.025}, .columns = 26, .rows = 26}, random));
  for (const int apart : {0, 1}) {
    const Belief belief = felt_twice(surface, apart, 1.0);
    Misfit change{.kind = MisfitKind::Gain,
                  .from_batch = 1,
                  .number = belief.palpations().size() / 2,
                  .amount = 0.5};
    EXPECT_NEAR(log_scale_of(change, belief), -0.5 * belief.site_count() * std::log(1.5), 1e-9);
    change.kind = MisfitKind::Moved;
    EXPECT_EQ(log_scale_of(change, belief), 0.0);
  }
}

}  // namespace
}  // namespace palpation
