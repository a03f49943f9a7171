// What healthy tissue adds: its covariance against the kernel's, its draws against closed forms.
#include "certainty/outline_background.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace palpation {
namespace {

constexpr double kMm = 1e-3, kLength_m = 6 * kMm;

struct Touched {
  std::vector<Vec2> places;
  std::vector<double> when;
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

TEST(BackgroundTerms, WavesAreASquaredExponentialField) {
  const auto [places, when] = grid(9, 13, 4 * kMm);
  const BackgroundTerms terms = background_terms(places, when);
  const Eigen::MatrixXd waves = terms.of_readings.leftCols(terms.of_readings.cols() - 1);
  const Eigen::MatrixXd covariance = waves * waves.transpose();
  for (std::size_t a = 0; a < places.size(); a += 7) {
    for (std::size_t b = 0; b < places.size(); b += 5) {
      const double square = (places[a] - places[b]).squaredNorm() / (kLength_m * kLength_m);
      // One term in a hundred of the spectrum is left out, and at a margin of 1.5 lengths an image
      // of the place is felt from three lengths away: exp(-4.5).
      EXPECT_NEAR(covariance(static_cast<int>(a), static_cast<int>(b)), std::exp(-0.5 * square),
                  0.05);
    }
  }
}

TEST(BackgroundTerms, DriftRisesByOneFromTheFirstBatchToTheLast) {
  const auto [places, when] = grid(3, 5, 4 * kMm);
  const Eigen::MatrixXd terms = background_terms(places, when).of_readings;
  const Eigen::VectorXd drift = terms.col(terms.cols() - 1);
  EXPECT_DOUBLE_EQ(drift[0], -0.5);
  EXPECT_DOUBLE_EQ(drift[7], 0.0);
  EXPECT_DOUBLE_EQ(drift[14], 0.5);
}

TEST(BackgroundTerms, OfLargeTissueAreLongerWavesAndNotMore) {
  const auto [places, when] = grid(40, 40, 10 * kMm);
  EXPECT_LE(background_terms(places, when).of_readings.cols(), 129);
}

// The sd's prior, where readings tell nothing.
TEST(OutlineBackground, IsDrawnFromItsPriorWhereReadingsTellNothing) {
  const auto [places, when] = grid(6, 6, 4 * kMm);
  BackgroundTerms terms = background_terms(places, when);
  terms.median_sd = 0.2;
  terms.drift_sd = 3.0;
  OutlineBackground background(terms);
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(36);
  Random random(5);
  constexpr int kDraws = 4000;
  double mean = 0.0, square = 0.0, drift = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    background.draw(nothing, nothing, random);
    const double z = std::log(background.waves_sd() / 0.2);
    mean += z / kDraws;
    square += z * z / kDraws;
    // Waves at the same place cancel: what is left between first and last batch is not drift alone,
    // but has its variance and theirs at the least.
    drift += std::pow(background.at(35) - background.at(0), 2) / kDraws;
  }
  EXPECT_NEAR(mean, 0.0, 0.1);  // five standard errors of draws correlated over three
  EXPECT_NEAR(square, 1.0, 0.15);
  EXPECT_GT(drift, 8.0);
}

// All coefficients known but for noise: a wave of one term and a drift are told apart.
TEST(OutlineBackground, FollowsWhatIsThere) {
  auto [places, when] = grid(8, 8, 3 * kMm);
  for (std::size_t i = 0; i < when.size(); ++i) when[i] = static_cast<double>((i * 29) % 64);
  BackgroundTerms terms = background_terms(places, when);
  terms.median_sd = 0.1;
  terms.drift_sd = 0.5;
  Random random(6);
  Eigen::VectorXd truth(64), off(64);
  for (int i = 0; i < 64; ++i) {
    truth[i] = 0.3 * std::sin(150.0 * places[i].x()) + 0.4 * (when[i] / 63.0 - 0.5);
    off[i] = truth[i] + 0.05 * random.normal();
  }
  OutlineBackground background(terms);
  double square = 0.0, scatter = 0.0;
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(64);
  constexpr int kDraws = 200;
  for (int draw = 0; draw < kDraws; ++draw) {
    background.draw(off, Eigen::VectorXd::Constant(64, 400.0), random);
    for (int i = 0; i < 64; ++i) mean[i] += background.at(i) / kDraws;
    scatter += std::pow(background.at(27) - truth[27], 2) / kDraws;
  }
  for (int i = 0; i < 64; ++i) square += std::pow(mean[i] - truth[i], 2) / 64.0;
  EXPECT_LT(std::sqrt(square), 0.04);  // less than the noise: what is smooth is known better
  EXPECT_LT(std::sqrt(scatter), 0.1);
}

TEST(OutlineBackground, AddsNothingWhereThereAreNoReadings) {
  const OutlineBackground none;
  EXPECT_TRUE(none.is_none());
  EXPECT_EQ(none.at(3), 0.0);
  EXPECT_EQ(none.log_density(), 0.0);
  EXPECT_TRUE(OutlineBackground(background_terms({}, {})).is_none());
}

}  // namespace
}  // namespace palpation
