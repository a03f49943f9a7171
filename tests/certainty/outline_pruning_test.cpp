// Loops of a first outline that the readings do not pay for.
#include "certainty/outline_pruning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "palpation/base/random.h"

namespace palpation {
namespace {

constexpr double kMm = 1e-3;

std::vector<Vec2> circle(const Vec2& middle, double radius_m, double turns) {
  std::vector<Vec2> line;
  const int nodes = static_cast<int>(2.0 * std::numbers::pi * radius_m / kMm);
  for (int i = 0; i < nodes; ++i) {
    const double angle = turns * 2.0 * std::numbers::pi * i / nodes;
    line.push_back(middle + radius_m * Vec2(std::cos(angle), std::sin(angle)));
  }
  return line;
}

struct Loop {
  Vec2 middle;
  double radius_m;
  bool is_there = true;
  bool is_hole = false;
};

/// On tissue of 60 by 40 mm, with `noise` of a contrast of 2, which is taken for half as much.
OutlineStart start_of(const std::vector<Loop>& loops, double noise) {
  OutlineStart start;
  OutlineNodes truth;
  int part = -1;
  for (const Loop& loop : loops) {
    const std::vector<Vec2> line = circle(loop.middle, loop.radius_m, loop.is_hole ? -1.0 : 1.0);
    part += loop.is_hole ? 0 : 1;
    start.outline.add(line, part);
    if (loop.is_there) truth.add(line, part);
  }
  Random random(51);
  for (int x = -30; x <= 30; x += 5) {
    for (int y = -20; y <= 20; y += 5) {
      const Vec2 place = kMm * Vec2(x, y);
      const double share = 1.0 / (1.0 + std::exp(-1200.0 * depth_in(truth, place)));
      start.readings.places.push_back(place);
      start.readings.reading.push_back(7.0 + 2.0 * (share + noise * random.normal()));
      start.readings.variance.push_back(0.25 * noise * noise);
    }
  }
  OutlineProfile& median = start.prior.median;
  median.low = 7.0;
  median.high = 9.0;
  median.log_slope = std::log(1200.0);
  median.turns.log_half_width = std::log(0.12);
  median.log_spacing.assign(loops.size(), std::log(kMm));
  median.log_contrast.assign(static_cast<std::size_t>(part) + 1, 0.0);
  start.profile = median;
  return start;
}

std::vector<double> areas_mm2(const OutlineNodes& outline) {
  std::vector<double> areas;
  for (const NodeLoop& loop : outline.loops) {
    const auto first = outline.place.begin() + loop.first;
    areas.push_back(1e6 * enclosed_area({first, first + loop.count}));
  }
  return areas;
}

const Loop kTumour{kMm * Vec2(-15, 0), 9 * kMm}, kSecond{kMm * Vec2(17, 0), 6 * kMm};

Loop none(Loop loop) {
  loop.is_there = false;
  return loop;
}

Loop hole_in(const Loop& loop, double radius_m) {
  return {.middle = loop.middle, .radius_m = radius_m, .is_there = loop.is_there, .is_hole = true};
}

TEST(OutlinePruning, KeepsWhatReadingsTell) {
  const OutlineStart start = start_of({kTumour, hole_in(kTumour, 5 * kMm), kSecond}, 0.1);
  EXPECT_EQ(areas_mm2(pruned(start, 1).outline), areas_mm2(start.outline));
}

TEST(OutlinePruning, TakesPartsThatAreNoise) {
  const Loop small = none({kMm * Vec2(0, 16), 3 * kMm});
  const OutlineStart start = start_of({kTumour, none(kSecond), small}, 0.25),
                     kept = pruned(start, 1);
  ASSERT_EQ(kept.outline.loops.size(), 1u);
  EXPECT_EQ(areas_mm2(kept.outline).front(), areas_mm2(start.outline).front());
  EXPECT_EQ(kept.profile.log_contrast.size(), 1u);
  EXPECT_EQ(kept.profile.log_spacing.size(), 1u);
  EXPECT_EQ(kept.prior.median.log_spacing.size(), 1u);
  EXPECT_EQ(kept.prior.median.log_contrast.size(), 1u);
}

// A walk may come to a hole between readings that pays for itself: of 24 four do.
TEST(OutlinePruning, FillsAHoleThatIsNoise) {
  int kept = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const OutlineStart start = start_of({kTumour, none(hole_in(kTumour, 4 * kMm))}, 0.1);
    kept += pruned(start, seed).outline.loops.size() > 1u ? 1 : 0;
  }
  EXPECT_LE(kept, 1);
}

TEST(OutlinePruning, APartThatGoesTakesItsHoleAlong) {
  const Loop gone = none(kSecond);
  EXPECT_EQ(pruned(start_of({kTumour, gone, hole_in(gone, 2 * kMm)}, 0.1), 1).outline.loops.size(),
            1u);
}

// Whatever walk asks: none loses a hole for one state in which its readings tell nothing.
TEST(OutlinePruning, PartsThatStayAreCountedAnew) {
  const Loop between = none({kMm * Vec2(0, 16), 4 * kMm});
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const OutlineNodes kept =
        pruned(start_of({kTumour, between, kSecond, hole_in(kSecond, 4 * kMm)}, 0.1), seed).outline;
    ASSERT_EQ(kept.loops.size(), 3u) << seed;
    EXPECT_EQ(kept.loops[1].part, 1);
    EXPECT_EQ(kept.loops[2].part, 1);
  }
}

}  // namespace
}  // namespace palpation
