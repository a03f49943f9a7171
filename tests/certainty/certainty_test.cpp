#include "palpation/certainty/certainty.h"

#include <gtest/gtest.h>

#include "belief/tissue.h"
#include "certainty/doubts.h"
#include "palpation/base/error.h"
#include "palpation/certainty/expected_error.h"
#include "palpation/certainty/level_estimate.h"

namespace palpation {
namespace {

Marginals marginals_of(std::vector<double> mean, std::vector<double> variance) {
  return {Eigen::Map<Eigen::VectorXd>(mean.data(), static_cast<Eigen::Index>(mean.size())),
          Eigen::Map<Eigen::VectorXd>(variance.data(), static_cast<Eigen::Index>(variance.size()))};
}

TEST(LevelFromRange, IsTheFractionBetweenLeastAndGreatestMean) {
  const Marginals marginals = marginals_of({7.0, 9.0, 8.5, 7.5}, {1, 1, 1, 1});
  EXPECT_DOUBLE_EQ(level_from_range(marginals, 0.5).value, 8.0);
  EXPECT_DOUBLE_EQ(level_from_range(marginals, 0.7).value, 8.4);
  EXPECT_FALSE(level_from_range(marginals, 0.7).stddev.has_value());
  EXPECT_THROW(level_from_range(marginals, 0.0), InvalidInput);
}

TEST(ProbabilityInside, IsThatOfANormal) {
  const Field p = probability_inside(
      marginals_of({8.0, 9.0, 7.0, 8.0, 9.0, 7.0}, {1.0, 1.0, 1.0, 0.0, 0.0, 0.0}),
      {8.0, std::nullopt});
  EXPECT_DOUBLE_EQ(p[0], 0.5);
  EXPECT_NEAR(p[1], 0.8413447460685429, 1e-15);  // Phi(1)
  EXPECT_NEAR(p[2], 0.15865525393145707, 1e-15);
  EXPECT_EQ(p[3], 1.0);  // at the level and sure of it: inside, by the half-open rule
  EXPECT_EQ(p[4], 1.0);
  EXPECT_EQ(p[5], 0.0);
  EXPECT_NEAR(probability_inside(marginals_of({9.0}, {0.5}), {8.0, std::sqrt(0.5)})[0],
              0.8413447460685429, 1e-15);
}

TEST(ExpectedError, AddsUpTheAreaThatMayBeWrong) {
  const Surface square = plane(2, 2);  // 25 x 50 mm, four vertices
  const Marginals marginals = marginals_of({9.0, 9.0, 7.0, 7.0}, {1.0, 1.0, 1.0, 1.0});
  const ExpectedError error = expected_error(square, marginals, {8.0, std::nullopt});
  const double tail = 0.15865525393145707;
  EXPECT_NEAR(error.symmetric_difference_m2(), tail * 0.025 * 0.050, 1e-15);
  EXPECT_NEAR(error.extra_m2 + error.missed_m2, error.symmetric_difference_m2(), 1e-18);
}

TEST(DoubtedAsAWhole, ABandWidensByHowFarAllReadingsMayLieOff) {
  const Surface sheet = plane(51, 3);  // 25 mm along x
  const Field sd = Field::Constant(sheet.vertex_count(), 0.0005);
  Certainty certainty{.score = (sheet.mesh().vertices.col(0).array() - 0.0126) / 0.0005,
                      .band_score = 2.0,
                      .half_width_m = 0.001,
                      .expected = {}};
  certainty.expected.missed_m2 = 1e-5;
  const Certainty doubted = doubted_as_a_whole(certainty, sheet, sd, 0.0012);
  EXPECT_NEAR(doubted.half_width_m, 2.0 * 0.0013, 1e-9);  // 0.5^2 + 1.2^2 = 1.3^2
  EXPECT_NEAR(doubted.expected.missed_m2, 2.6e-5, 1e-10);
  EXPECT_EQ((doubted.score.array() > 0.0).count(), (certainty.score.array() > 0.0).count());
  const Certainty same = doubted_as_a_whole(certainty, sheet, sd, 0.0);
  EXPECT_NEAR((same.score - certainty.score).cwiseAbs().maxCoeff(), 0.0, 1e-12);
}

// Inside of 12.6 mm, or, as likely, of 20 mm; or nothing at all.
TEST(AsLikelyAnother, WhatOneOfThemHasIsAsLikelyTumourAsNot) {
  const Surface sheet = plane(51, 3);  // 25 mm along x, each vertex 0.5 mm of it
  const auto right_of = [&](double x_m) {
    return Field((sheet.mesh().vertices.col(0).array() - x_m) / 0.0001);
  };
  Certainty certainty{.score = right_of(0.0126), .band_score = 2.0, .expected = {}};
  const Certainty either = as_likely_another(certainty, sheet, right_of(0.0199));
  const Field p = either.probability_inside();
  const double strip_m2 =
      7.25e-3 * 0.05;  // from the vertex at 13 mm to that at 20, half a step off
  for (int vertex = 0; vertex < sheet.vertex_count(); ++vertex) {
    const double x_m = sheet.vertex(vertex).x();
    EXPECT_NEAR(p[vertex], x_m < 0.0126 ? 0.0 : x_m < 0.0199 ? 0.5 : 1.0, 0.17) << x_m;
  }
  EXPECT_NEAR(either.expected.extra_m2, 0.5 * strip_m2, 0.5 * 0.25e-3 * 0.05 + 1e-9);
  EXPECT_NEAR(either.expected.missed_m2, 0.0, 1e-9);
  const Certainty or_none = as_likely_another(certainty, sheet, std::nullopt);
  EXPECT_NEAR(or_none.expected.extra_m2, 0.5 * 0.01225 * 0.05, 1e-9);
  EXPECT_NEAR(or_none.probability_inside().maxCoeff(), 0.5, 1e-6);
}

TEST(DoubtedWhereUntouched, APlaceFarFromAllReadingsIsNoSurerThanTheField) {
  const Surface sheet = plane(51, 3);  // 25 mm along x; touched along its left edge alone
  const Belief belief = Belief(Prior(sheet, Metric::Chart, {.length_m = 0.004}), {.noise_sd = 0.1})
                            .condition_on(std::vector{touch(sheet, 0, 9.0), touch(sheet, 51, 9.0),
                                                      touch(sheet, 102, 9.0)});
  const int count = sheet.vertex_count();
  const Marginals marginals{.mean = Field::Constant(count, 7.0),
                            .variance = Field::Constant(count, 3.0)};
  const Certainty sure{.score = Field::Constant(count, -9.0), .expected = {}};
  const Certainty told =
      doubted_where_untouched(sure, belief, marginals, {.value = 11.0, .stddev = 1.0});
  double untouched_m2 = 0.0;
  for (int vertex = 0; vertex < count; ++vertex) {
    const bool is_far = sheet.vertex(vertex).x() >= 0.008;
    EXPECT_DOUBLE_EQ(told.score[vertex], is_far ? -2.0 : -9.0) << vertex;  // 4 over sqrt(3 + 1)
    if (is_far) untouched_m2 += sheet.vertex_areas()[vertex];
  }
  EXPECT_NEAR(told.untouched_m2, untouched_m2, 1e-15);
  EXPECT_NEAR(told.untouched_error_m2, 0.02275013194817921 * untouched_m2, 1e-15);  // Phi(-2)
  EXPECT_DOUBLE_EQ(told.expected_in_all_m2() - told.expected.symmetric_difference_m2(),
                   told.untouched_error_m2);
}

}  // namespace
}  // namespace palpation
