#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "boundary/superlevel_parts.h"
#include "palpation/base/random.h"
#include "palpation/certainty/edge_belief.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

constexpr double kRadius_m = 0.004, kNoise = 0.06;
const Vec3 kStrong(0.008, 0.0125, 0.0), kOther(0.029, 0.0125, 0.0);

Surface wide_tissue() {
  Random random(0);
  return Surface(make_plane({.size_m = {0.037, 0.025}, .columns = 75, .rows = 51}, random));
}

double share_of_disk(const Vec3& place, const Vec3& centre) {
  return 1.0 / (1.0 + std::exp(1400.0 * ((place - centre).norm() - kRadius_m)));
}

/// The belief in two disks, 2 above the rest and `contrast` of that, from readings at random
/// vertices.
EdgeBelief belief_of_two(const Surface& surface, double contrast, int readings,
                         std::uint64_t seed) {
  Random random(seed);
  const Prior prior(surface, Metric::Chart, Kernel{.length_m = 0.0045, .signal_sd = 1.0});
  std::vector<Palpation> palpations;
  for (int i = 0; i < readings; ++i) {
    const auto vertex = static_cast<int>(random.uniform() * surface.vertex_count());
    const Vec3 place = surface.vertex(vertex);
    const double reading =
        7.0 + 2.0 * share_of_disk(place, kStrong) + 2.0 * contrast * share_of_disk(place, kOther);
    palpations.push_back(
        {.where = surface.at_vertex(vertex), .reading = reading + kNoise * random.normal()});
  }
  const Belief belief = Belief(prior, {.noise_sd = kNoise}).condition_on(palpations);
  constexpr double kFirstLevels[] = {8.0};
  return EdgeBelief::around(belief, belief.at_vertices(), kFirstLevels, 0.5).value();
}

/// Area that the boundary and that disk do not agree on.
double area_off_m2(const Surface& surface, const Field& depth, const Vec3& centre) {
  double off = 0.0;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    const double from_centre = (surface.vertex(vertex) - centre).norm();
    if (from_centre > 0.01) continue;
    if ((from_centre < kRadius_m) != (depth[vertex] >= 0.0)) off += surface.vertex_areas()[vertex];
  }
  return off;
}

class OwnContrast : public testing::TestWithParam<double> {};

TEST_P(OwnContrast, PutsTheOutlineOfAWeakerPartAtItsOwnHalfHeight) {
  const Surface surface = wide_tissue();
  const double disk_m2 = std::acos(-1.0) * kRadius_m * kRadius_m;
  for (const std::uint64_t seed : {1, 2}) {
    const EdgeBelief edge = belief_of_two(surface, GetParam(), 250, seed);
    EXPECT_EQ(superlevel_parts(surface, edge.depth(), 0.0).size(), 2);
    EXPECT_LT(area_off_m2(surface, edge.depth(), kOther), 0.25 * disk_m2) << seed;
    EXPECT_LT(area_off_m2(surface, edge.depth(), kStrong), 0.25 * disk_m2) << seed;
    ASSERT_EQ(edge.parts().size(), 2);
    const PartContrast& weaker = edge.parts().back();
    EXPECT_LT((surface.position(weaker.where) - kOther).norm(), kRadius_m);
    EXPECT_NEAR(weaker.of_strongest, GetParam(), 0.06);
    EXPECT_LT(std::abs(weaker.of_strongest - GetParam()), 4.0 * weaker.stddev);
  }
}

// At 0.7 the strongest's level cuts both parts, at 0.5 just so, at 0.4 one.
INSTANTIATE_TEST_SUITE_P(AllContrasts, OwnContrast, testing::Values(0.4, 0.5, 0.55, 0.7));

TEST(OwnContrast, IsNotSaidOfPartsThatAreEqual) {
  const Surface surface = wide_tissue();
  int said = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed)
    said += !belief_of_two(surface, 1.0, 150, seed).parts().empty();
  EXPECT_LE(said, 1);
}

}  // namespace
}  // namespace palpation
