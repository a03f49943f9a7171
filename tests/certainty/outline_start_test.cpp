#include "certainty/outline_start.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "certainty/edge_data.h"
#include "palpation/base/random.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

constexpr double kRadius_m = 0.006, kNoise = 0.1;

Surface tissue() {
  Random random(0);
  return Surface(make_plane({.size_m = {0.03, 0.03}, .columns = 31, .rows = 31}, random));
}

/// More places than are all known one by one, of a disk of 9 in 7.
std::vector<Palpation> felt(const Surface& surface, double noise) {
  Random random(3);
  std::vector<Palpation> palpations;
  for (int vertex = 0; vertex < surface.vertex_count(); vertex += 2) {
    const double depth = kRadius_m - (surface.vertex(vertex) - Vec3(0.015, 0.015, 0.0)).norm();
    palpations.push_back(
        {.where = surface.at_vertex(vertex),
         .reading = 7.0 + 2.0 / (1.0 + std::exp(-1400.0 * depth)) + noise * random.normal()});
  }
  return palpations;
}

OutlineReadings readings_of(const Surface& surface, const std::vector<Palpation>& palpations,
                            double noise_sd, const OutlineOptions& options = {}) {
  const Prior prior(surface, Metric::Chart, Kernel{.length_m = 0.0045, .signal_sd = 1.0});
  const Belief belief = Belief(prior, {.noise_sd = noise_sd}).condition_on(palpations);
  const Marginals marginals = belief.at_vertices();
  constexpr double kFirstLevels[] = {8.0};
  const auto edge = EdgeBelief::around(belief, marginals, kFirstLevels, 0.5);
  return outline_start(belief, marginals.mean, edge.value(), options).value().readings;
}

TEST(OutlineStart, KnowsManyReadingsToTheBitInWhateverOrderTheyWereMade) {
  const Surface surface = tissue();
  std::vector<Palpation> palpations = felt(surface, kNoise);
  const OutlineReadings readings = readings_of(surface, palpations, kNoise);
  ASSERT_LT(readings.places.size(), palpations.size());
  std::ranges::reverse(palpations);
  const OutlineReadings reversed = readings_of(surface, palpations, kNoise);
  EXPECT_EQ(readings.places, reversed.places);
  EXPECT_EQ(readings.reading, reversed.reading);
  EXPECT_EQ(readings.variance, reversed.variance);
}

TEST(OutlineStart, TakesReadingsWithoutNoiseAmongMany) {
  const Surface surface = tissue();
  std::vector<Palpation> palpations = felt(surface, kNoise);
  for (std::size_t i = 0; i < palpations.size(); i += 10) palpations[i].noise_variance = 0.0;
  const OutlineReadings readings = readings_of(surface, palpations, kNoise);
  ASSERT_LT(readings.places.size(), palpations.size());
  EXPECT_TRUE(std::ranges::all_of(readings.reading, [](double one) { return std::isfinite(one); }));
  EXPECT_GT(std::ranges::min(readings.variance), 0.0);
}

// What was taken back beside one edge would speak for that edge.
TEST(OutlineStart, GivesBackADriftThatLastingErrorsExplain) {
  const Surface surface = tissue();
  const std::vector<Palpation> palpations = felt(surface, kNoise);
  OutlineOptions options;
  options.background.drift = Eigen::VectorXd::Constant(std::ssize(palpations), 0.5);
  const OutlineReadings without = readings_of(surface, palpations, kNoise, options);
  options.background.errors_in_turn = {.readings = 10.0, .sd = 0.2};
  const OutlineReadings with = readings_of(surface, palpations, kNoise, options);
  ASSERT_EQ(with.reading.size(), without.reading.size());
  for (std::size_t i = 0; i < with.reading.size(); ++i)
    EXPECT_NEAR(with.reading[i], without.reading[i] + 0.5, 1e-12) << i;
  EXPECT_GT(with.background.seen, without.background.seen);
}

/// Of a round outline, 3 mm wide to each side, whose nodes lie so far from the nearest reading.
double size_log_sd(double gap_m) {
  OutlineStart start;
  std::vector<Vec2> circle;
  for (int i = 0; i < 19; ++i) {
    const Vec2 way(std::cos(2.0 * std::numbers::pi * i / 19),
                   std::sin(2.0 * std::numbers::pi * i / 19));
    circle.push_back(0.003 * way);
    start.readings.places.push_back((0.003 + gap_m) * way);
  }
  OutlineNodes outline;
  outline.add(circle, 0);
  begin_with(outline, start);
  return start.prior.size_log_sd;
}

TEST(OutlineStart, IsTheLessSureOfItsSizeTheFartherReadingsLie) {
  EXPECT_EQ(size_log_sd(0.0005), 0.3);
  EXPECT_NEAR(size_log_sd(0.0015), 0.5, 0.02);
  EXPECT_EQ(size_log_sd(0.01), 1.0);
}

}  // namespace
}  // namespace palpation
