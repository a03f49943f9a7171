#include <gtest/gtest.h>

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

constexpr double kNoise = 0.05;

Surface tissue() {
  Random random(0);
  return Surface(make_plane({.size_m = {0.04, 0.05}, .columns = 41, .rows = 51}, random));
}

using Stiffness = std::function<double(const Vec3& place)>;

double disk(const Vec3& place) {
  return 2.0 / (1.0 + std::exp(-1200.0 * (0.007 - (place - Vec3(0.018, 0.022, 0.0)).norm())));
}

double wave(const Vec3& place) {
  return std::sin(2.0 * std::numbers::pi * (place.x() + 0.5 * place.y()) / 0.06);
}

double bowl(const Vec3& place) { return 3000.0 * (place - Vec3(0.022, 0.02, 0.0)).squaredNorm(); }

Conclusion concluded(const Surface& surface, const Stiffness& stiffness, std::uint64_t seed) {
  Random random(seed);
  std::vector<Palpation> palpations;
  for (int i = 0; i < 120; ++i) {
    const int vertex = random.below(surface.vertex_count());
    palpations.push_back(
        {.where = surface.at_vertex(vertex),
         .reading = 7.0 + stiffness(surface.vertex(vertex)) + kNoise * random.normal(),
         .batch = i / 15});
  }
  return conclude(surface, {.level = {.estimate = LevelEstimate::Edge}}, palpations, nullptr, 1);
}

TEST(SlowWaves, OfHealthyTissueAreNoTumour) {
  const Surface surface = tissue();
  for (const Stiffness& healthy : {Stiffness(wave), Stiffness(bowl)}) {
    for (const std::uint64_t seed : {1, 2}) {
      const Conclusion conclusion = concluded(surface, healthy, seed);
      EXPECT_FALSE(conclusion.level) << seed;
      EXPECT_TRUE(conclusion.evidence.contrast_seen) << seed;
      ASSERT_TRUE(conclusion.evidence.of_edge) << seed;
      EXPECT_LT(conclusion.evidence.of_edge->log_odds, -surprising()) << seed;
    }
  }
}

TEST(SlowWaves, HideNoTumour) {
  const Surface surface = tissue();
  for (const Stiffness& background :
       {Stiffness(wave), Stiffness(bowl), Stiffness([](const Vec3&) { return 0.0; })}) {
    const Conclusion conclusion = concluded(
        surface, [&](const Vec3& place) { return disk(place) + 0.3 * background(place); }, 1);
    ASSERT_TRUE(conclusion.edge);
    EXPECT_GT(conclusion.edge->odds_over_waves().log_odds, 10.0);
    ASSERT_TRUE(conclusion.outlines);
    EXPECT_NEAR(conclusion.outlines->area_m2.mean * 1e6, std::numbers::pi * 49.0, 25.0);
  }
}

/// As high as the tumour, or half again.
TEST(SlowWaves, AreTakenBackFromTissueWithATumour) {
  const Surface surface = tissue();
  for (const Stiffness& background : {Stiffness(wave), Stiffness(bowl)}) {
    const Conclusion conclusion = concluded(
        surface, [&](const Vec3& place) { return disk(place) + background(place); }, 1);
    ASSERT_FALSE(conclusion.evidence.taken_back.empty());
    EXPECT_EQ(conclusion.evidence.taken_back.front().kind, MisfitKind::Waves);
    EXPECT_EQ(conclusion.evidence.taken_back.front().background.waves.size(),
              surface.vertex_count());
    ASSERT_TRUE(conclusion.outlines);
    EXPECT_NEAR(conclusion.outlines->area_m2.mean * 1e6, std::numbers::pi * 49.0, 25.0);
  }
}

/// Rows 3 mm apart, a reading each half millimetre, each of whose errors keeps a part of the one
/// before.
std::vector<Palpation> slides(const Surface& surface, const Stiffness& stiffness,
                              std::uint64_t seed, double kept, double sd) {
  Random random(seed);
  std::vector<Palpation> palpations;
  double error = sd * random.normal();
  for (int row = 0; row < 12; ++row) {
    for (int i = 0; i < 50; ++i) {
      error = kept * error + std::sqrt(1.0 - kept * kept) * sd * random.normal();
      const Vec3 place(0.006 + 0.0005 * i, 0.006 + 0.003 * row, 0.0);
      palpations.push_back({.where = surface.project(place),
                            .reading = 7.0 + stiffness(place) + error,
                            .kind = TouchKind::Way,
                            .travel = Vec3::UnitX()});
    }
  }
  return palpations;
}

// A sensor's filter makes readings that lie close together err alike: counted as so many that err
// each for itself, they would pay for any edge.
TEST(NoiseThatLasts, IsNoTumour) {
  const Surface surface = tissue();
  for (const std::uint64_t seed : {1, 2, 3}) {
    const std::vector<Palpation> healthy = slides(
        surface, [](const Vec3&) { return 0.0; }, seed, 0.7, 0.15);
    const Conclusion conclusion =
        conclude(surface, {.level = {.estimate = LevelEstimate::Edge}}, healthy, nullptr, 1);
    EXPECT_FALSE(conclusion.level) << seed;
    EXPECT_TRUE(conclusion.evidence.contrast_seen) << seed;
    ASSERT_TRUE(conclusion.evidence.of_edge) << seed;
    EXPECT_GT(conclusion.evidence.of_edge->errors.readings, 0.0) << seed;
  }
}

TEST(NoiseThatLasts, HidesNoTumour) {
  const Surface surface = tissue();
  const Conclusion conclusion = conclude(surface, {.level = {.estimate = LevelEstimate::Edge}},
                                         slides(surface, disk, 1, 0.7, 0.15), nullptr, 1);
  ASSERT_TRUE(conclusion.outlines);
  EXPECT_GT(conclusion.evidence.of_edge->log_odds, 10.0);
  EXPECT_NEAR(conclusion.outlines->area_m2.mean * 1e6, std::numbers::pi * 49.0, 25.0);
}

/// 144 stops in rows 4 mm apart, to and fro.
std::vector<Palpation> stops_in_rows(const Surface& surface, const Stiffness& stiffness,
                                     std::uint64_t seed) {
  constexpr double kKept = 0.9, kSd = 0.2;
  Random random(seed);
  std::vector<Palpation> palpations;
  double error = kSd * random.normal();
  for (int row = 0; row < 12; ++row) {
    for (int i = 0; i < 12; ++i) {
      error = kKept * error + std::sqrt(1.0 - kKept * kKept) * kSd * random.normal();
      const int column = row % 2 == 0 ? i : 11 - i;
      const Vec3 place(0.002 + 0.0033 * column, 0.003 + 0.004 * row, 0.0);
      palpations.push_back(
          {.where = surface.project(place), .reading = 7.0 + stiffness(place) + error});
    }
  }
  return palpations;
}

// Rows lie so far apart that no two readings but those of one row err alike by their places.
TEST(NoiseThatLasts, FromTouchToTouchIsNoTumour) {
  const Surface surface = tissue();
  const Model model{.level = {.estimate = LevelEstimate::Edge}};
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const std::vector<Palpation> healthy = stops_in_rows(
        surface, [](const Vec3&) { return 0.0; }, seed);
    const Conclusion conclusion = conclude(surface, model, healthy, nullptr, 1);
    EXPECT_FALSE(conclusion.level) << seed;
    if (!conclusion.evidence.of_edge) continue;
    EXPECT_GT(conclusion.evidence.of_edge->errors.readings, 0.0) << seed;
    EXPECT_LT(conclusion.evidence.of_edge->log_odds, -surprising()) << seed;
  }
}

TEST(NoiseThatLasts, FromTouchToTouchHidesNoTumour) {
  const Surface surface = tissue();
  const Model model{.level = {.estimate = LevelEstimate::Edge}};
  const Conclusion conclusion =
      conclude(surface, model, stops_in_rows(surface, disk, 1), nullptr, 1);
  ASSERT_TRUE(conclusion.edge);
  const EdgeInErrors edge = conclusion.edge->in_lasting_errors(Eigen::VectorXd::Zero(144));
  EXPECT_GT(edge.log_evidence, edge.log_evidence_without_edge + 10.0);
  ASSERT_TRUE(conclusion.outlines);
  EXPECT_NEAR(conclusion.outlines->area_m2.mean * 1e6, std::numbers::pi * 49.0, 25.0);
}

}  // namespace
}  // namespace palpation
