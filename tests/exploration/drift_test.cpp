#include "exploration/drift.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "palpation/base/random.h"
#include "palpation/exploration/conclusion.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

/// Of each of so many readings, without its mean.
Eigen::VectorXd walk(int readings, double step_sd, std::uint64_t seed) {
  Random random(seed);
  Eigen::VectorXd drift(readings);
  double at = 0.0;
  for (double& one : drift) one = at += step_sd * random.normal();
  return drift.array() - drift.mean();
}

double root_mean_square(const Eigen::VectorXd& values) {
  return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

/// Made one after the other, one in three on the upper line.
EdgeData on_two_lines(const Eigen::VectorXd& drift, std::uint64_t seed) {
  Random random(seed);
  EdgeData data;
  data.reading = drift;
  for (std::size_t number = 0; number < static_cast<std::size_t>(drift.size()); ++number) {
    data.places.emplace_back();
    data.made.push_back({{.number = number}});
    const bool is_high = random.below(3) == 0;
    data.reading[static_cast<Eigen::Index>(number)] +=
        7.0 + (is_high ? 2.0 : 0.0) + 0.05 * random.normal();
  }
  return data;
}

TEST(DriftOfParallelLines, IsWhatBothLinesShare) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Eigen::VectorXd drift = walk(150, 0.1, seed);
    const std::vector<Eigen::VectorXd> found =
        drifts_of_parallel_lines(on_two_lines(drift, seed), 150, surprising(), 3);
    ASSERT_FALSE(found.empty()) << seed;
    const Eigen::VectorXd without_mean = found.front().array() - found.front().mean();
    EXPECT_LT(root_mean_square(without_mean - drift), 0.15) << seed;  // a step and a half
  }
}

TEST(DriftOfParallelLines, IsNoneOfASensorThatStays) {
  const EdgeData data = on_two_lines(Eigen::VectorXd::Zero(150), 1);
  EXPECT_TRUE(drifts_of_parallel_lines(data, 150, surprising(), 3).empty());
}

TEST(DriftOfParallelLines, OfFewReadingsOrEqualOnesIsNone) {
  EXPECT_TRUE(drifts_of_parallel_lines(on_two_lines(walk(14, 1.0, 1), 1), 14, 0.0, 3).empty());
  EdgeData equal = on_two_lines(Eigen::VectorXd::Zero(20), 1);
  equal.reading.setConstant(7.0);
  EXPECT_TRUE(drifts_of_parallel_lines(equal, 20, 0.0, 3).empty());
}

double disk(const Vec3& place) {
  return 2.0 / (1.0 + std::exp(-1200.0 * (0.007 - (place - Vec3(0.018, 0.022, 0.0)).norm())));
}

/// 144 stops in rows 4 mm apart, to and fro.
Conclusion concluded(const Eigen::VectorXd& drift, std::uint64_t seed) {
  Random random(seed);
  const Surface surface(make_plane({.size_m = {0.04, 0.05}, .columns = 41, .rows = 51}, random));
  std::vector<Palpation> palpations;
  for (int row = 0; row < 12; ++row) {
    for (int i = 0; i < 12; ++i) {
      const int column = row % 2 == 0 ? i : 11 - i;
      const Vec3 place(0.002 + 0.0033 * column, 0.003 + 0.004 * row, 0.0);
      palpations.push_back(
          {.where = surface.project(place),
           .reading = 7.0 + disk(place) + drift[12 * row + i] + 0.05 * random.normal()});
    }
  }
  return conclude(surface, {.level = {.estimate = LevelEstimate::Edge}}, palpations, nullptr, 1);
}

// As high as the tumour from its least to its greatest.
TEST(Drift, BesideATumourIsTakenBack) {
  for (const std::uint64_t seed : {1, 2}) {
    const Eigen::VectorXd drift = walk(144, 0.15, seed);
    ASSERT_GT(drift.maxCoeff() - drift.minCoeff(), 1.0);
    const Conclusion conclusion = concluded(drift, seed);
    const std::vector<Misfit>& changes = conclusion.evidence.taken_back;
    ASSERT_FALSE(changes.empty()) << seed;
    ASSERT_EQ(changes.front().kind, MisfitKind::Drift) << seed;
    EXPECT_GT(changes.front().background.errors.readings, 0.0);
    EXPECT_LT(root_mean_square(changes.front().background.drift - drift), 0.25) << seed;
    ASSERT_TRUE(conclusion.outlines);
    EXPECT_NEAR(conclusion.outlines->area_m2.mean * 1e6, std::numbers::pi * 49.0, 30.0) << seed;
  }
}

TEST(Drift, OfASensorThatStaysIsNone) {
  const Conclusion conclusion = concluded(Eigen::VectorXd::Zero(144), 1);
  EXPECT_TRUE(conclusion.evidence.taken_back.empty());
}

}  // namespace
}  // namespace palpation
