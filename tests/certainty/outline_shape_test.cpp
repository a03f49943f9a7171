// Outlines' shapes beforehand: how densely lines close, against lines that are drawn.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "certainty/outline_model.h"
#include "certainty/outline_walk.h"
#include "certainty/turn_law.h"
#include "drawn_turns.h"
#include "regular_polygon.h"

namespace palpation {
namespace {

constexpr double kMm = 1e-3;
constexpr double kPieceLogSd = 0.25;

/// With sides of a millimetre.
OutlineNodes polygon(int nodes) {
  return regular_polygon(nodes, 0.5 * kMm / std::sin(std::numbers::pi / nodes));
}

OutlineProfile profile_of(const Turns& turns, double spacing_m) {
  OutlineProfile profile;
  profile.turns = turns;
  profile.log_spacing = {std::log(spacing_m)};
  return profile;
}

/// What the shape's density was divided by.
double log_density_of_closing(int nodes, const Turns& turns, double spacing_m) {
  const OutlineNodes outline = polygon(nodes);
  const OutlineProfile profile = profile_of(turns, spacing_m);
  double open = log_turns_density(outline, 0, nodes, profile);
  for (int node = 0; node < nodes; ++node)
    open += log_length_density(outline.place[node], outline.place[outline.next(node)],
                               profile.log_spacing[0]);
  return open - log_shape_density(outline, profile);
}

double within_half_a_turn(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

/// The mean, over lines whose last piece is missing, of how dense the one that closes them, the
/// turns at its ends and all bends are.
double density_of_closing_by_drawing(int nodes, const Turns& turns, Random& random) {
  constexpr int kLines = 200'000;
  const TurnDensity density(turns);
  const double even = turns.kind == LineKind::Polygonal ? 0.0 : 2.0 * std::numbers::pi / nodes;
  double sum = 0.0;
  for (int line = 0; line < kLines; ++line) {
    double direction = 0.0, log_weight = 0.0;
    Vec2 end = Vec2::Zero();
    bool is_within = true;
    std::vector<double> off;
    for (int piece = 0; piece + 1 < nodes; ++piece) {
      const double length = std::exp(kPieceLogSd * random.normal());
      end += length * Vec2(std::cos(direction), std::sin(direction));
      if (piece + 2 == nodes) break;
      const DrawnTurn turn =
          off.empty() ? first_turn(turns, random) : next_turn(off.back(), turns, random);
      off.push_back(turn.off);
      log_weight += turn.log_weight;
      is_within = is_within && std::abs(even + off.back()) < std::numbers::pi;
      direction += even + off.back();
    }
    const double back = std::atan2(-end.y(), -end.x()), length = end.norm(),
                 z = std::log(length) / kPieceLogSd, turned = within_half_a_turn(back - direction),
                 last = within_half_a_turn(-back);
    if (!is_within || std::abs(direction + turned + last - 2.0 * std::numbers::pi) > 1e-6) continue;
    off.push_back(turned - even);
    off.push_back(last - even);
    for (int i : {nodes - 2, nodes - 1})
      log_weight += log_cauchy(off[i], turns) + std::log(density.of_bend(off[i] - off[i - 1]));
    log_weight += std::log(density.of_bend(off.front() - off.back()));
    sum += std::exp(log_weight - 0.5 * z * z) /
           (kPieceLogSd * std::sqrt(2.0 * std::numbers::pi) * length * length);
  }
  return sum / kLines;
}

TEST(OutlineShape, LinesCloseAsDenselyAsDrawnOnesDo) {
  Random random(41);
  for (const LineKind kind : {LineKind::Smooth, LineKind::Angular}) {
    const Turns narrow{std::log(0.01), kind};
    const double first = log_density_of_closing(12, narrow, kMm) -
                         std::log(density_of_closing_by_drawing(12, narrow, random));
    for (const double turn : {0.03, 0.1, 0.3}) {
      const Turns turns{std::log(turn), kind};
      const double drawn = density_of_closing_by_drawing(12, turns, random);
      EXPECT_NEAR(log_density_of_closing(12, turns, kMm) - first, std::log(drawn), std::log(2.0));
    }
  }
}

// By the factor of lines that curve, or one kind would be more probable than it is; few of those
// that are drawn close.
TEST(OutlineShape, PolygonsCloseAsDenselyAsDrawnOnesDo) {
  Random random(44);
  constexpr int kNodes = 24;
  const Turns curved{std::log(0.03), LineKind::Smooth, 1.0};
  const double first = log_density_of_closing(kNodes, curved, kMm) -
                       std::log(density_of_closing_by_drawing(kNodes, curved, random));
  for (const double turn : {0.03, 0.1}) {
    const Turns turns{std::log(turn), LineKind::Polygonal};
    const double drawn = density_of_closing_by_drawing(kNodes, turns, random);
    EXPECT_NEAR(log_density_of_closing(kNodes, turns, kMm) - first, std::log(drawn), std::log(10.0))
        << turn;
  }
}

TEST(OutlineShape, LinesOfPiecesTwiceAsLongCloseAQuarterAsDensely) {
  const Turns turns{std::log(0.1), LineKind::Smooth};
  EXPECT_NEAR(log_density_of_closing(40, turns, 2 * kMm),
              log_density_of_closing(40, turns, kMm) - std::log(4.0), 1e-12);
}

// With neither readings nor a price of closing, seven loops would be circles: their turns' half
// width would lie seven standard deviations below its median.
TEST(OutlineShape, ManyLoopsAreAsRoughBeforehandAsOne) {
  for (const int loops : {1, 7}) {
    OutlineNodes outline;
    for (int i = 0; i < loops; ++i) {
      std::vector<Vec2> line = polygon(24).place;
      for (Vec2& place : line) place.x() += 0.1 * i;
      outline.add(line, 0);
    }
    OutlinePrior prior;
    prior.median = profile_of({std::log(0.12), LineKind::Smooth}, kMm);
    prior.median.log_spacing.resize(outline.loops.size(), std::log(kMm));
    prior.median.log_contrast = {0.0};
    const OutlineReadings nothing;
    OutlineWalk walk(nothing, prior, outline, prior.median, 42);
    walk.settle(300);
    double log_turn = 0.0, log_bend = 0.0;
    for (const OutlineDraw& draw : walk.draws(2000, 500)) {
      log_turn += draw.profile.turns.log_half_width / 500.0;
      log_bend += draw.profile.turns.log_bend / 500.0;
    }
    EXPECT_NEAR(log_turn, prior.median.turns.log_half_width, 1.5) << loops;
    EXPECT_NEAR(log_bend, prior.median.turns.log_bend, 1.5) << loops;
  }
}

// With no readings every second outline leans, of those that curve two in three are smooth, and
// some are polygons, as they are beforehand; walks seldom go from these to those, so of six.
TEST(OutlineShape, KindsAreAsProbableWithoutReadingsAsBeforehand) {
  OutlinePrior prior;
  prior.median = profile_of({std::log(0.12), LineKind::Smooth}, kMm);
  prior.median.log_contrast = {0.0};
  const OutlineReadings nothing;
  double leaning = 0.0, far = 0.0;
  std::map<LineKind, double> of_kind;
  constexpr int kWalks = 6, kDraws = 12000;
  const double kMedianLean = 0.25 * std::sqrt(2.0);
  for (std::uint64_t seed = 44; seed < 44 + kWalks; ++seed) {
    OutlineWalk walk(nothing, prior, polygon(24), prior.median, seed);
    walk.settle(300);
    for (const OutlineDraw& draw : walk.draws(3 * kDraws / kWalks, kDraws / kWalks)) {
      leaning += draw.profile.lean ? 1.0 : 0.0;
      far += draw.profile.lean && draw.profile.lean->head<2>().norm() > kMedianLean ? 1.0 : 0.0;
      of_kind[draw.profile.turns.kind] += 1.0 / kDraws;
    }
  }
  EXPECT_NEAR(leaning / kDraws, 0.5, 0.05);
  EXPECT_NEAR(far / leaning, 0.5, 0.05);
  EXPECT_NEAR(of_kind[LineKind::Smooth] / (1.0 - of_kind[LineKind::Polygonal]), 2.0 / 3.0, 0.1);
  EXPECT_GT(of_kind[LineKind::Polygonal], 0.05);
  EXPECT_LT(of_kind[LineKind::Polygonal], 0.7);
}

}  // namespace
}  // namespace palpation
