// The law of a closed line's turns, against turns that are drawn independently and weighed.
#include "certainty/turn_law.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "palpation/base/random.h"

namespace palpation {
namespace {

constexpr int kNodes = 12;

/// Over lines of turns as Cauchy's law alone has them.
struct Drawn {
  double weight = 0.0;      ///< mean of all bends' B
  double all_around = 0.0;  ///< mean cosine of the sum of all turns, so weighed
};
Drawn drawn_lines(const Turns& of, Random& random) {
  const double half_width = std::exp(of.log_half_width);
  constexpr int kLines = 200'000;
  const double most = std::atan(std::numbers::pi / half_width);
  Drawn drawn;
  for (int line = 0; line < kLines; ++line) {
    std::array<double, kNodes> turns{};
    double sum = 0.0, log_weight = 0.0;
    for (double& turn : turns) {
      turn = half_width * std::tan(most * (2.0 * random.uniform() - 1.0));
      sum += turn;
    }
    for (int i = 0; i < kNodes; ++i)
      log_weight += log_bend_density(turns[(i + 1) % kNodes] - turns[i], of);
    drawn.weight += std::exp(log_weight) / kLines;
    drawn.all_around += std::exp(log_weight) * std::cos(sum) / kLines;
  }
  // Cauchy's law up to half a turn.
  drawn.weight *= std::pow(most / (0.5 * std::numbers::pi), kNodes);
  drawn.all_around *= std::pow(most / (0.5 * std::numbers::pi), kNodes);
  return drawn;
}

TEST(TurnLaw, IsDividedByWhatAllLinesHave) {
  Random random(51);
  for (const Bends bends : {Bends::Smooth, Bends::Angular}) {
    for (const double half_width : {0.02, 0.1, 0.3}) {
      const double drawn = drawn_lines({std::log(half_width), bends}, random).weight;
      EXPECT_NEAR(kNodes * turn_law({std::log(half_width), bends}).log_share, std::log(drawn), 0.1)
          << half_width;
    }
  }
}

TEST(TurnLaw, LinesPointApartAsDrawnOnesDo) {
  Random random(52);
  for (const Bends bends : {Bends::Smooth, Bends::Angular}) {
    for (const double half_width : {0.02, 0.1, 0.3}) {
      const Drawn drawn = drawn_lines({std::log(half_width), bends}, random);
      EXPECT_NEAR(0.5 * kNodes * turn_law({std::log(half_width), bends}).variance,
                  -std::log(drawn.all_around / drawn.weight), 0.2)
          << half_width;
    }
  }
}

TEST(TurnLaw, BendsDoNotMatterToSmallTurns) {
  EXPECT_NEAR(turn_law({std::log(0.002), Bends::Smooth}).log_share, 0.0, 0.05);
  EXPECT_NEAR(turn_law({std::log(0.002), Bends::Angular}).log_share, 0.0, 0.05);
}

// A corner of a right angle takes two bends.
TEST(TurnLaw, CornersAreLikelierThanBendsThatAreNormal) {
  constexpr double kRight = 0.5 * std::numbers::pi;
  const Turns smooth{0.0, Bends::Smooth}, angular{0.0, Bends::Angular};
  EXPECT_GT(log_bend_density(kRight, smooth),
            -0.5 * std::pow(kRight / 0.25, 2) + 2.0 * std::log(10.0));
  EXPECT_LT(log_bend_density(kRight, smooth), log_bend_density(0.1, smooth) - 2.0);
  EXPECT_GT(log_bend_density(kRight, angular), log_bend_density(kRight, smooth) + 1.0);
}

}  // namespace
}  // namespace palpation
