// The law of a closed line's turns, against turns that are drawn and weighed.
#include "certainty/turn_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "drawn_turns.h"
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
  constexpr int kLines = 200'000;
  Drawn drawn;
  for (int line = 0; line < kLines; ++line) {
    DrawnTurn turn = first_turn(of, random);
    const double first = turn.off;
    double sum = first, log_weight = 0.0;
    bool is_within = std::abs(first) < std::numbers::pi;
    for (int i = 1; i < kNodes; ++i) {
      turn = next_turn(turn.off, of, random);
      sum += turn.off;
      log_weight += turn.log_weight;
      is_within = is_within && std::abs(turn.off) < std::numbers::pi;
    }
    if (!is_within) continue;
    log_weight += std::log(TurnDensity(of).of_bend(first - turn.off));
    drawn.weight += std::exp(log_weight) / kLines;
    drawn.all_around += std::exp(log_weight) * std::cos(sum) / kLines;
  }
  return drawn;
}

std::vector<Turns> kinds_of_turns(const std::vector<double>& log_half_widths) {
  std::vector<Turns> all;
  for (const LineKind kind : {LineKind::Smooth, LineKind::Angular}) {
    for (const double bend : {0.1, 0.25}) {
      for (const double log_half_width : log_half_widths)
        all.push_back({log_half_width, kind, std::log(bend)});
    }
  }
  return all;
}

std::string text_of(const Turns& turns) {
  return std::to_string(turns.log_half_width) + ", " + std::to_string(turns.log_bend);
}

TEST(TurnLaw, IsDividedByWhatAllLinesHave) {
  Random random(51);
  for (const Turns& turns : kinds_of_turns({-4.0, -2.3, -1.1, 0.0})) {
    const double drawn = drawn_lines(turns, random).weight;
    EXPECT_NEAR(kNodes * turn_law(turns).log_share, std::log(drawn), 0.3) << text_of(turns);
  }
}

TEST(TurnLaw, LinesPointApartAsDrawnOnesDo) {
  Random random(52);
  for (const Turns& turns : kinds_of_turns({-4.0, -2.3, -1.1})) {
    const Drawn drawn = drawn_lines(turns, random);
    const double variance = -2.0 * std::log(drawn.all_around / drawn.weight) / kNodes;
    EXPECT_NEAR(std::log(turn_law(turns).variance / variance), 0.0, 0.15) << text_of(turns);
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

// The more a line bends, the more lines there are, and the wider do they turn; beyond what is
// tabulated no more, or the density would grow without end.
TEST(TurnLaw, IsKnownHoweverMuchLinesBend) {
  for (const LineKind kind : {LineKind::Smooth, LineKind::Angular}) {
    TurnLaw before = turn_law({-2.0, kind, -9.0});
    for (double log_bend = -3.9; log_bend < 1.0; log_bend += 0.1) {
      const TurnLaw law = turn_law({-2.0, kind, log_bend});
      EXPECT_GE(law.variance, before.variance) << log_bend;
      EXPECT_GT(law.log_share, before.log_share) << log_bend;
      before = law;
    }
    EXPECT_EQ(turn_law({-2.0, kind, 1.0}).log_share, turn_law({-2.0, kind, 40.0}).log_share);
    EXPECT_EQ(TurnDensity({-2.0, kind, 1.0}).of_bend(1.0),
              TurnDensity({-2.0, kind, 40.0}).of_bend(1.0));
  }
}

// By hand: exp(-2) + 1.1 * 0.25 / (1 + 0.04), and with 6.7.
TEST(TurnLaw, BendsAreAsLikelyAsByHand) {
  const double log_bend = std::log(0.25);
  EXPECT_NEAR(TurnDensity({0.0, LineKind::Smooth, log_bend}).of_bend(0.5), 0.3997584, 1e-6);
  EXPECT_NEAR(TurnDensity({0.0, LineKind::Angular, log_bend}).of_bend(0.5), 1.7459121, 1e-6);
}

TEST(TurnLaw, PolygonsTurnAsDrawnOnesDo) {
  Random random(53);
  for (const double log_half_width : {-4.0, -2.0, 0.0}) {
    const Turns turns{log_half_width, LineKind::Polygonal};
    const TurnDensity density(turns);
    constexpr int kPlaces = 100'000, kDrawn = 100'000;
    double whole = 0.0, corners = 0.0, drawn_corners = 0.0, all_around = 0.0;
    for (int i = 0; i < kPlaces; ++i) {
      const double turn = std::numbers::pi * (2.0 * (i + 0.5) / kPlaces - 1.0),
                   share = 2.0 * density.at(turn, 0.1) / kPlaces;
      whole += share;
      corners += std::abs(turn) > 1.0 ? share : 0.0;
    }
    for (int i = 0; i < kDrawn; ++i) {
      double sum = 0.0;
      for (int node = 0; node < kNodes; ++node) sum += first_turn(turns, random).off;
      all_around += std::cos(sum) / kDrawn;
      drawn_corners += std::abs(first_turn(turns, random).off) > 1.0 ? 1.0 / kDrawn : 0.0;
    }
    EXPECT_NEAR(whole, 1.0, 1e-4);
    EXPECT_NEAR(drawn_corners, corners, 0.005);
    EXPECT_NEAR(all_around, std::exp(-0.5 * kNodes * turn_law(turns).variance), 0.01);
    EXPECT_EQ(turn_law(turns).log_share, 0.0);
  }
}

}  // namespace
}  // namespace palpation
