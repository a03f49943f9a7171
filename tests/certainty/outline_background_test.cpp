// What healthy tissue adds: its covariance against the kernel's.
#include "certainty/outline_background.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <vector>

#include "palpation/base/random.h"

namespace palpation {
namespace {

constexpr double kMm = 1e-3;
constexpr std::array kLengths_m = {3.5 * kMm, 8 * kMm};

struct Touched {
  std::vector<Vec2> places;
  std::vector<double> when;

  BackgroundTerms terms(const Eigen::MatrixXd& steps = {}) const {
    return background_terms({.places = places, .when = when, .steps = steps});
  }
};

Touched grid(int columns, int rows, double step_m) {
  Touched touched;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      touched.places.push_back(step_m * Vec2(column, row));
      touched.when.push_back(row);
    }
  }
  return touched;
}

Eigen::MatrixXd covariance_of_waves(const BackgroundTerms& terms, std::size_t length) {
  const auto waves =
      terms.of_readings.middleCols(length == 0 ? 0 : terms.waves[0], terms.waves[length]);
  return waves * waves.transpose();
}

TEST(BackgroundTerms, WavesAreSquaredExponentialFields) {
  const Touched touched = grid(9, 13, 4 * kMm);
  const std::vector<Vec2>& places = touched.places;
  for (const std::size_t length : {0u, 1u}) {
    const Eigen::MatrixXd covariance = covariance_of_waves(touched.terms(), length);
    for (std::size_t a = 0; a < places.size(); ++a) {
      for (std::size_t b = 0; b < places.size(); ++b) {
        const double steps = (places[a] - places[b]).norm() / kLengths_m[length];
        // What is left out is a covariance itself: nowhere more than the most at one place.
        EXPECT_NEAR(covariance(static_cast<int>(a), static_cast<int>(b)),
                    std::exp(-0.5 * steps * steps), 0.02 + 1e-9);
      }
    }
  }
}

TEST(BackgroundTerms, WavesAreTheSameHoweverTissueLies) {
  Random random(3);
  Touched here, there;
  const Eigen::Rotation2D<double> turn(0.7);
  for (int i = 0; i < 150; ++i) {
    here.places.push_back(kMm * Vec2(25.0 * random.uniform(), 50.0 * random.uniform()));
    there.places.push_back(turn * here.places.back() + Vec2(0.3, -0.2));
    here.when.push_back(i);
  }
  there.when = here.when;
  for (const std::size_t length : {0u, 1u}) {
    const Eigen::MatrixXd one = covariance_of_waves(here.terms(), length),
                          other = covariance_of_waves(there.terms(), length);
    EXPECT_LT((one - other).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(BackgroundTerms, StepsComeLast) {
  Eigen::MatrixXd steps = Eigen::MatrixXd::Zero(6, 2);
  steps(4, 0) = steps(5, 0) = steps(5, 1) = 1.0;
  const BackgroundTerms terms = grid(2, 3, 4 * kMm).terms(steps);
  EXPECT_EQ(terms.of_readings.cols(), terms.waves[0] + terms.waves[1] + 5);
  EXPECT_EQ(terms.of_readings.rightCols(2), steps);
}

TEST(BackgroundTerms, DriftRisesByOneFromTheFirstBatchToTheLast) {
  const Eigen::MatrixXd terms = grid(3, 5, 4 * kMm).terms().of_readings;
  const Eigen::VectorXd drift = terms.rightCols(3).col(0);
  EXPECT_DOUBLE_EQ(drift[0], -0.5);
  EXPECT_DOUBLE_EQ(drift[7], 0.0);
  EXPECT_DOUBLE_EQ(drift[14], 0.5);
}

TEST(BackgroundTerms, TiltIsAPlaneHoweverTissueLies) {
  const Touched here = grid(3, 5, 4 * kMm);
  const Eigen::MatrixXd tilt = here.terms().of_readings.rightCols(2);
  EXPECT_NEAR(tilt.colwise().sum().cwiseAbs().maxCoeff(), 0.0, 1e-12);
  EXPECT_NEAR(tilt.squaredNorm(), 15.0, 1e-12);
  Touched there = here;
  for (Vec2& place : there.places) place = Eigen::Rotation2D<double>(0.7) * place + Vec2(0.3, -0.2);
  const Eigen::MatrixXd turned = there.terms().of_readings.rightCols(2);
  EXPECT_LT((turned * turned.transpose() - tilt * tilt.transpose()).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(BackgroundTerms, OfLargeTissueAreLongerWavesAndNotMore) {
  EXPECT_LE(grid(40, 40, 10 * kMm).terms().of_readings.cols(), 259);
}

TEST(BackgroundTerms, AreNoneWithoutReadings) { EXPECT_TRUE(background_terms({}).is_none()); }

}  // namespace
}  // namespace palpation
