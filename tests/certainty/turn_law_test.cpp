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
      log_weight += log_bend_density(turns[(i + 1) % kNodes] - turns[i], of.kind);
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
  for (const LineKind kind : {LineKind::Smooth, LineKind::Angular}) {
    for (const double log_half_width : {-4.0, -2.3, -1.1, 0.0}) {
      const double drawn = drawn_lines({log_half_width, kind}, random).weight;
      EXPECT_NEAR(kNodes * turn_law({log_half_width, kind}).log_share / std::log(drawn), 1.0, 0.03)
          << log_half_width;
    }
  }
}

TEST(TurnLaw, LinesPointApartAsDrawnOnesDo) {
  Random random(52);
  for (const LineKind kind : {LineKind::Smooth, LineKind::Angular}) {
    for (const double log_half_width : {-4.0, -2.3, -1.1}) {
      const Drawn drawn = drawn_lines({log_half_width, kind}, random);
      const double variance = -2.0 * std::log(drawn.all_around / drawn.weight) / kNodes;
      EXPECT_NEAR(std::log(turn_law({log_half_width, kind}).variance / variance), 0.0, 0.15)
          << log_half_width;
    }
  }
}

// The wider each turn may be, the wider is their sum, and the less likely are they alike.
TEST(TurnLaw, IsKnownHoweverWideItIs) {
  for (const LineKind kind : {LineKind::Smooth, LineKind::Angular}) {
    TurnLaw before = turn_law({-9.0, kind});
    for (double log_half_width = -6.9; log_half_width < 2.9; log_half_width += 0.1) {
      const TurnLaw law = turn_law({log_half_width, kind});
      EXPECT_GE(law.variance, before.variance) << log_half_width;
      EXPECT_LT(law.log_share, before.log_share) << log_half_width;
      before = law;
    }
    EXPECT_LT(before.variance, 2.0);
  }
}

// By hand: 0.9 exp(-2) + 0.1 / (1 + 0.04), and with 0.6 and 0.4.
TEST(TurnLaw, BendsAreAsLikelyAsByHand) {
  EXPECT_NEAR(log_bend_density(0.5, LineKind::Smooth), std::log(0.2179556), 1e-6);
  EXPECT_NEAR(log_bend_density(0.5, LineKind::Angular), std::log(0.4658166), 1e-6);
  EXPECT_EQ(log_bend_density(0.0, LineKind::Smooth), 0.0);
}

}  // namespace
}  // namespace palpation
