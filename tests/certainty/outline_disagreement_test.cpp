#include "certainty/outline_disagreement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace palpation {
namespace {

OutlineDraw disk(double radius_m) {
  std::vector<Vec2> line;
  for (int i = 0; i < 400; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 400;
    line.push_back(radius_m * Vec2(std::cos(angle), std::sin(angle)));
  }
  OutlineDraw draw;
  draw.outline.add(line, 0);
  return draw;
}

const std::vector<Vec2> kPlaces = {{0.006, 0.0}, {0.0, -0.007}, {-0.002, 0.002}};

// Depths are radii less what does not differ: means 2 mm apart, each with a deviation of 1 mm.
TEST(Disagreement, IsBetweenMeansOverWhatDrawsVary) {
  const std::vector draws = {disk(0.004), disk(0.006), disk(0.006), disk(0.008)};
  EXPECT_NEAR(disagreement_of(draws, kPlaces), 2.0, 1e-3);
}

TEST(Disagreement, IsNoneBetweenDrawsThatAreTheSame) {
  const std::vector some = {disk(0.004), disk(0.006), disk(0.006), disk(0.004)};
  EXPECT_NEAR(disagreement_of(some, kPlaces), 0.0, 1e-9);
  EXPECT_EQ(disagreement_of(std::vector(4, disk(0.005)), kPlaces), 0.0);
}

}  // namespace
}  // namespace palpation
