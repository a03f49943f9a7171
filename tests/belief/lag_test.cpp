#include "palpation/belief/lag.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "belief/tissue.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr Hyperparameters kField{.length_m = 0.0035, .signal_sd = 0.8, .noise_sd = 0.06};

double stiffness(const Vec3& p) {
  return 7.0 + 2.0 / (1.0 + std::exp(1400.0 * ((p - Vec3(0.0115, 0.030, 0.0)).norm() - 0.00625)));
}

/// Touches at vertices from random directions; each says what the tissue is a lag behind.
std::vector<Palpation> late_readings(const Surface& surface, int count, double lag_m,
                                     double noise_sd, std::uint64_t seed) {
  Random random(seed);
  std::vector<Palpation> readings;
  for (int i = 0; i < count; ++i) {
    Palpation palpation = touch(surface, random.below(surface.vertex_count()), 0.0);
    const double angle = 6.283185307179586 * random.uniform();
    palpation.travel = {std::cos(angle), std::sin(angle), 0.0};
    palpation.reading = stiffness(surface.position(palpation.where) - lag_m * palpation.travel) +
                        noise_sd * random.normal();
    readings.push_back(palpation);
  }
  return readings;
}

Prior field_on(const Surface& tissue) {
  return Prior(tissue, Metric::Chart, {.length_m = kField.length_m, .signal_sd = kField.signal_sd});
}

TEST(Displaced, ReadingsGoBackAlongTheirTravel) {
  const Surface tissue = plane(26, 51);
  Palpation palpation = touch(tissue, 26 * 25 + 13, 7.0);
  palpation.travel = Vec3(0.6, -0.8, 0.0);
  const std::vector<Palpation> moved = displaced(tissue, std::vector{palpation}, 0.002);
  const Vec3 expected = tissue.position(palpation.where) - Vec3(0.0012, -0.0016, 0.0);
  EXPECT_NEAR((tissue.position(moved[0].where) - expected).norm(), 0.0,
              1e-15);  // rounding of a closest point
}

TEST(Displaced, WithoutLagOrTravelNothingChanges) {
  const Surface tissue = plane(26, 51);
  const std::vector<Palpation> readings = late_readings(tissue, 20, 0.001, 0.0, 1);
  const std::vector<Palpation> same = displaced(tissue, readings, 0.0);
  std::vector<Palpation> still = readings;
  for (Palpation& palpation : still) palpation.travel.setZero();
  const std::vector<Palpation> unmoved = displaced(tissue, still, 0.002);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    EXPECT_TRUE(same[i].where.barycentric == readings[i].where.barycentric &&
                same[i].where.face == readings[i].where.face);
    EXPECT_TRUE(unmoved[i].where.barycentric == readings[i].where.barycentric &&
                unmoved[i].where.face == readings[i].where.face);
  }
  EXPECT_THROW(displaced(tissue, readings, std::numeric_limits<double>::quiet_NaN()), InvalidInput);
}

TEST(Displaced, WhatBelongsBeyondTheBorderIsSetAside) {
  const Surface tissue = plane(26, 51);
  Palpation first = touch(tissue, 0, 7.0);
  first.travel = Vec3::UnitX();  // onto the tissue
  const std::vector<Palpation> moved = displaced(tissue, std::vector{first}, 0.002);
  EXPECT_EQ(moved[0].set_aside, "belongs beyond the tissue");
  EXPECT_EQ(displaced(tissue, std::vector{first}, 0.0004)[0].set_aside, "");
}

TEST(LearnLag, FindsTheLagOfAField) {
  const Surface tissue = plane(51, 101);
  for (const double lag_m : {0.0, 0.0007, 0.0015, 0.0026}) {
    const auto lag =
        learn_lag(field_on(tissue), late_readings(tissue, 150, lag_m, 0.02, 3), kField);
    ASSERT_TRUE(lag.has_value());
    EXPECT_NEAR(lag->value_m, lag_m, 0.0002);
    EXPECT_LT(lag->stddev_m, 0.0002);
  }
}

// Of an edge, which no field of one length is: the curvature alone says half of it.
TEST(LearnLag, ScattersAsFarAsItSays) {
  const Surface tissue = plane(26, 51);
  constexpr int kTrials = 40;
  double squares = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto lag =
        learn_lag(field_on(tissue), late_readings(tissue, 80, 0.0012, 0.06, 100 + trial), kField);
    squares += std::pow((lag->value_m - 0.0012) / lag->stddev_m, 2) / kTrials;
  }
  // Of 40 normals the mean square lies between .6 and 1.5 in 98 of 100.
  EXPECT_GT(squares, 0.6);
  EXPECT_LT(squares, 1.5);
}

// The same posterior on a fine grid, factored anew by Belief: nothing on it is more probable.
TEST(LearnLag, NoLagOnAFineGridIsMoreProbable) {
  const Surface tissue = plane(26, 51);
  const std::vector<Palpation> readings = late_readings(tissue, 60, 0.0011, 0.05, 5);
  std::vector<Palpation> inner;
  for (const Palpation& palpation : readings) {
    const Vec3 p = tissue.position(palpation.where);
    if (std::min({p.x(), 0.025 - p.x(), p.y(), 0.050 - p.y()}) > 0.003) inner.push_back(palpation);
  }
  const auto log_posterior = [&](double lag_m) {
    const Belief belief = Belief(field_on(tissue), {.noise_sd = kField.noise_sd})
                              .condition_on(displaced(tissue, inner, lag_m));
    return belief.log_marginal_likelihood() - 0.5 * std::pow((lag_m - 0.0005) / 0.0015, 2);
  };
  const double found = log_posterior(learn_lag(field_on(tissue), inner, kField)->value_m);
  for (double lag_m = -0.0005; lag_m <= 0.003; lag_m += 0.00005)
    EXPECT_LE(log_posterior(lag_m), found + 1e-3) << lag_m;
}

// A raster to and fro whose base falls along every row: alone that looks like a lag of its own.
TEST(LearnLag, OnARasterDriftOfTheBaseIsNoLag) {
  const Surface tissue = plane(26, 51);
  Random random(6);
  std::vector<Palpation> rows;
  for (int column = 0; column < 26; column += 2) {
    const double way = column % 4 == 0 ? 1.0 : -1.0;
    for (int row = 0; row < 51; row += 2) {
      Palpation palpation = touch(tissue, row * 26 + column, 0.0);
      palpation.travel = way * Vec3::UnitY();
      const Vec3 p = tissue.position(palpation.where);
      const double along = 0.5 + way * (p.y() / 0.050 - 0.5);
      palpation.reading =
          stiffness(p - 0.0015 * palpation.travel) - 0.1 * along + 0.02 * random.normal();
      rows.push_back(palpation);
    }
  }
  EXPECT_NEAR(learn_lag(field_on(tissue), rows, kField)->value_m, 0.0015, 0.0003);
}

TEST(LearnLag, OfReadingsThatTellNothingIsThePriors) {
  const Surface tissue = plane(26, 51);
  std::vector<Palpation> alike = late_readings(tissue, 30, 0.0, 0.0, 2);
  for (Palpation& palpation : alike) palpation.reading = 7.0;
  const auto lag =
      learn_lag(field_on(tissue), alike, {.length_m = 0.02, .signal_sd = 0.01, .noise_sd = 1.0});
  ASSERT_TRUE(lag.has_value());
  EXPECT_NEAR(lag->value_m, 0.0005, 0.0001);
  EXPECT_NEAR(lag->stddev_m, 0.0015, 0.0001);
}

TEST(LearnLag, SaysWhenItRanIntoItsBound) {
  const Surface tissue = plane(51, 101);
  EXPECT_TRUE(
      learn_lag(field_on(tissue), late_readings(tissue, 150, 0.0045, 0.02, 3), kField)->at_bound);
  EXPECT_FALSE(
      learn_lag(field_on(tissue), late_readings(tissue, 150, 0.0015, 0.02, 3), kField)->at_bound);
}

TEST(LearnLag, IsNothingWithoutTravel) {
  const Surface tissue = plane(26, 51);
  Random random(1);
  EXPECT_FALSE(learn_lag(field_on(tissue), bumpy_readings(tissue, 30, random), kField).has_value());
  EXPECT_FALSE(learn_lag(field_on(tissue), {}, kField).has_value());
}

TEST(LearnLag, OfThousandsOfReadingsIsAsGood) {
  const Surface tissue = plane(51, 101);
  const auto lag =
      learn_lag(field_on(tissue), late_readings(tissue, 3000, 0.0015, 0.02, 4), kField);
  EXPECT_NEAR(lag->value_m, 0.0015, 0.0001);
}

}  // namespace
}  // namespace palpation
