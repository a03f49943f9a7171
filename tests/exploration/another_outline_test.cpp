// A second half of the readings that was made by another probe, or another registration.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include "palpation/base/random.h"
#include "palpation/exploration/conclusion.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

constexpr int kReadings = 150;

double depth_in_disk(const Vec3& place) {
  return 0.007 - (place - Vec3(0.016, 0.0145, 0.0)).norm();
}

/// What the second half feels as deep as that.
using Felt = std::function<double(const Vec3& place)>;

Conclusion concluded(const Felt& second, std::uint64_t seed, bool are_sessions) {
  Random random(seed);
  const Surface surface(make_plane({.size_m = {0.03, 0.03}, .columns = 51, .rows = 51}, random));
  std::vector<Palpation> felt;
  for (int i = 0; i < kReadings; ++i) {
    const auto vertex = static_cast<int>(random.uniform() * surface.vertex_count());
    const bool is_second = 2 * i >= kReadings;
    const Vec3 place = surface.vertex(vertex);
    const double depth_m = is_second ? second(place) : depth_in_disk(place);
    felt.push_back(
        {.where = surface.at_vertex(vertex),
         .reading = 7.0 + 2.0 / (1.0 + std::exp(-1400.0 * depth_m)) + 0.06 * random.normal(),
         .session = is_second && are_sessions ? 1 : 0});
  }
  return conclude(surface, {.level = {.estimate = LevelEstimate::Edge}}, felt, nullptr, seed);
}

double wider(const Vec3& place) { return depth_in_disk(place) + 0.0015; }

TEST(AnotherOutline, OfAWiderTipIsSaidAndWidensTheBand) {
  const Conclusion same = concluded(depth_in_disk, 1, true);
  EXPECT_FALSE(same.evidence.another_outline);
  for (const bool are_sessions : {true, false}) {
    const Conclusion both = concluded(wider, 1, are_sessions);
    ASSERT_TRUE(both.evidence.another_outline) << are_sessions;
    const Misfit& since = *both.evidence.another_outline;
    EXPECT_EQ(since.session, are_sessions ? 1 : 0);
    EXPECT_NEAR(static_cast<double>(since.number), kReadings / 2, 8.0);
    EXPECT_NEAR(since.amount, 0.0015, 0.0007);
    EXPECT_GT(both.certainty->half_width_m, same.certainty->half_width_m + 0.001);
    // Which of them is right is not known.
    const double narrow_m2 = std::numbers::pi * std::pow(0.007, 2),
                 wide_m2 = std::numbers::pi * std::pow(0.0085, 2),
                 found_m2 = both.outlines->area_m2.mean;
    EXPECT_GT(both.certainty->expected.symmetric_difference_m2(),
              0.5 * std::max(found_m2 - narrow_m2, wide_m2 - found_m2));
  }
}

TEST(AnotherOutline, OfAScaleThatIsLongerIsSaid) {
  const auto longer = [](const Vec3& place) {
    const Vec3 middle(0.004, 0.004, 0.0);
    return depth_in_disk(middle + 0.9 * (place - middle));
  };
  EXPECT_TRUE(concluded(longer, 2, true).evidence.another_outline);
}

}  // namespace
}  // namespace palpation
