// What readings are off by: its density against the readings' whole covariance, its draws against
// their laws.
#include "certainty/outline_residuals.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace palpation {
namespace {

constexpr double kMm = 1e-3;

struct Readings : OutlineReadings {
  std::vector<double> when, off;
};

/// In eight rows of eight, the rows made in turn, without residuals.
Readings raster(double variance) {
  Readings readings;
  for (int i = 0; i < 64; ++i) {
    readings.places.push_back(3 * kMm * Vec2(i % 8, i / 8));
    readings.when.push_back((i * 29) % 64);
  }
  readings.off.assign(64, 0.0);
  readings.variance.assign(64, variance);
  Eigen::MatrixXd step = Eigen::MatrixXd::Zero(64, 1);
  step.bottomRows(20).setOnes();
  readings.background =
      background_terms({.places = readings.places, .when = readings.when, .steps = step});
  readings.background.median_sd = 0.1;
  readings.background.drift_sd = 0.5;
  readings.background.tilt_sd = 0.4;
  readings.background.step_sd[0] = 0.3;
  return readings;
}

OutlineResiduals residuals_of(const Readings& readings, const ResidualPrior& prior = {}) {
  return {readings, readings.off, prior, prior.log_noise};
}

Eigen::VectorXd as_vector(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                           static_cast<Eigen::Index>(numbers.size()));
}

/// Of noise and background, with scales of 1.
Eigen::MatrixXd covariance_by_hand(const Readings& readings) {
  const BackgroundTerms& terms = readings.background;
  Eigen::VectorXd sd = Eigen::VectorXd::Constant(terms.of_readings.cols(), terms.median_sd);
  sd[sd.size() - 4] = terms.drift_sd;
  sd.segment(sd.size() - 3, 2).setConstant(terms.tilt_sd);
  sd[sd.size() - 1] = terms.step_sd[0];
  Eigen::MatrixXd covariance = as_vector(readings.variance).asDiagonal();
  const Eigen::MatrixXd added = terms.of_readings * sd.asDiagonal();
  covariance += added * added.transpose();
  return covariance;
}

double log_density_by_hand(const Readings& readings) {
  const Eigen::LLT<Eigen::MatrixXd> factor(covariance_by_hand(readings));
  const Eigen::VectorXd off = as_vector(readings.off);
  return -0.5 * off.dot(factor.solve(off)) - factor.matrixLLT().diagonal().array().log().sum() -
         0.5 * static_cast<double>(off.size()) * std::log(2.0 * std::numbers::pi) +
         static_cast<double>(off.size()) * std::log(0.99) +
         98.0 * std::log(0.99);  // of how often a reading tells nothing: Beta's law of 1 and 99
}

TEST(OutlineResiduals, HaveTheDensityOfNoiseAndBackgroundTogether) {
  Readings readings = raster(0.01);
  Random random(1);
  for (double& off : readings.off) off = 0.2 * random.normal();
  EXPECT_NEAR(residuals_of(readings).log_density(), log_density_by_hand(readings), 1e-9);
}

TEST(OutlineResiduals, AreWeighedFewAtATimeAsAllTogether) {
  Readings readings = raster(0.01);
  Random random(2);
  OutlineResiduals residuals = residuals_of(readings);
  for (int round = 0; round < 40; ++round) {
    const double before = residuals.log_density();
    Readings next = readings;
    for (int i = 0; i < 5; ++i) {
      const auto reading = static_cast<std::size_t>((round * 13 + i * 11) % 64);
      next.off[reading] = 0.2 * random.normal();
      residuals.consider(reading, next.off[reading]);
    }
    EXPECT_NEAR(residuals.change(), log_density_by_hand(next) - log_density_by_hand(readings),
                1e-8);
    if (round % 2 == 0) {
      residuals.forget();
      EXPECT_EQ(residuals.log_density(), before);
    } else {
      residuals.keep();
      readings = next;
    }
    EXPECT_EQ(residuals.change(), 0.0);
    EXPECT_NEAR(residuals.log_density(), log_density_by_hand(readings), 1e-8);
  }
}

TEST(OutlineResiduals, WeighColumnsByTheWholeCovariance) {
  const Readings readings = raster(0.01);
  Random random(7);
  Eigen::MatrixXd columns(64, 3);
  for (double& one : columns.reshaped()) one = random.normal();
  const Eigen::MatrixXd expected =
      columns.transpose() * covariance_by_hand(readings).llt().solve(columns);
  EXPECT_LT((residuals_of(readings).products(columns) - expected).norm(), 1e-9 * expected.norm());
}

TEST(OutlineResiduals, OfReadingsThatTellNothingDoNotMatter) {
  Readings readings = raster(0.01);
  readings.off[9] = 40.0;
  readings.off[17] = -300.0;
  OutlineResiduals residuals = residuals_of(readings);
  Random random(3);
  for (int i = 0; i < 5; ++i) residuals.redraw(random);
  EXPECT_FALSE(residuals.tells(9));
  EXPECT_FALSE(residuals.tells(17));
  int telling = 0;
  for (std::size_t i = 0; i < 64; ++i) telling += residuals.tells(i);
  EXPECT_GE(telling, 58);
  residuals.consider(9, 0.7);
  EXPECT_EQ(residuals.change(), 0.0);
}

/// That a drift, and nothing else, is likely: waves, tilt and step add nothing to speak of.
Readings that_may_drift() {
  Readings readings = raster(0.01);
  readings.background.median_sd = readings.background.tilt_sd = readings.background.step_sd[0] =
      1e-6;
  Random random(11);
  for (std::size_t i = 0; i < 64; ++i)
    readings.off[i] = 0.1 * random.normal() + 0.08 * (readings.when[i] / 63.0 - 0.5);
  return readings;
}

// By how densely the readings' whole covariance has them with a drift and without.
TEST(OutlineResiduals, DriftAsOftenAsTheReadingsSay) {
  const Readings readings = that_may_drift();
  Readings still = readings;
  still.background.drift_sd = 1e-6;
  const double odds = std::exp(log_density_by_hand(readings) - log_density_by_hand(still));
  OutlineResiduals residuals =
      residuals_of(readings, {.noise_log_sd = 1e-9, .wild_density = 1e-12});
  const Eigen::MatrixXd drift =
      readings.background.of_readings.col(readings.background.of_readings.cols() - 4);
  const double if_still = residuals_of(still).products(drift)(0, 0);
  Random random(12);
  double drifts = 0.0;
  constexpr int kDraws = 8'000;
  for (int i = 0; i < kDraws; ++i) {
    residuals.redraw(random);
    drifts += residuals.products(drift)(0, 0) < 0.9 * if_still ? 1.0 / kDraws : 0.0;
  }
  EXPECT_GT(odds / (1.0 + odds), 0.1);
  EXPECT_LT(odds / (1.0 + odds), 0.9);
  EXPECT_NEAR(drifts, odds / (1.0 + odds), 0.04);
}

// Where they are asked to, a sharp reading that fits badly widens the noise.
TEST(OutlineResiduals, KeepTellingWhereTheyAreToldTo) {
  Readings readings = raster(0.01);
  readings.off[9] = 4.0;
  OutlineResiduals residuals = residuals_of(readings);
  Random random(13);
  for (int i = 0; i < 50; ++i) residuals.redraw(random, true);
  EXPECT_TRUE(residuals.tells(9));
  EXPECT_GT(residuals.log_noise(), std::log(2.0));
  for (int i = 0; i < 50; ++i) residuals.redraw(random);
  EXPECT_FALSE(residuals.tells(9));
}

// Without a background and with the noise known, a reading tells nothing as often as Bayes' rule
// says.
TEST(OutlineResiduals, AReadingTellsNothingAsOftenAsItShould) {
  const ResidualPrior prior{.noise_log_sd = 1e-9, .wild_density = 0.1};
  Readings readings;
  readings.off = {0.38, 0.0};
  readings.variance = {0.01, 0.01};
  OutlineResiduals residuals = residuals_of(readings, prior);
  Random random(4);
  double nothing = 0.0;
  constexpr int kDraws = 20'000;
  for (int i = 0; i < kDraws; ++i) {
    residuals.redraw(random);
    nothing += residuals.tells(0) ? 0.0 : 1.0 / kDraws;
  }
  const double wild = 0.01 * 0.1, normal = 0.99 * std::exp(-0.5 * 3.8 * 3.8) /
                                           (0.1 * std::sqrt(2.0 * std::numbers::pi));
  EXPECT_NEAR(nothing, wild / (wild + normal), 0.014);  // four standard errors
}

// Twenty of 120 tell nothing: the share's posterior is Beta's law of 21 and 199.
TEST(OutlineResiduals, LearnHowManyReadingsTellNothing) {
  Readings readings;
  Random random(6);
  for (int i = 0; i < 120; ++i) readings.off.push_back((i < 20 ? 30.0 : 0.1) * random.normal());
  readings.off.push_back(0.35);
  readings.variance.assign(121, 0.01);
  OutlineResiduals residuals = residuals_of(readings, {.noise_log_sd = 1e-9, .wild_density = 0.01});
  double nothing = 0.0;
  constexpr int kDraws = 20'000;
  for (int i = 0; i < 100 + kDraws; ++i) {
    residuals.redraw(random);
    if (i >= 100) nothing += residuals.tells(120) ? 0.0 : 1.0 / kDraws;
  }
  const double share = 21.0 / 220.0, wild = share * 0.01,
               normal = (1.0 - share) * std::exp(-0.5 * 3.5 * 3.5) /
                        (0.1 * std::sqrt(2.0 * std::numbers::pi));
  EXPECT_NEAR(nothing, wild / (wild + normal), 0.03);
}

// The scale of a noise that is known up to it, by n residuals: that of a variance's posterior.
TEST(OutlineResiduals, LearnTheNoise) {
  Readings readings;
  Random random(5);
  for (int i = 0; i < 200; ++i) readings.off.push_back(0.3 * random.normal());
  readings.variance.assign(200, 0.01);
  OutlineResiduals residuals = residuals_of(readings, {.wild_density = 1e-6});
  double mean = 0.0, square = 0.0;
  constexpr int kDraws = 4000;
  for (int i = 0; i < 100 + kDraws; ++i) {
    residuals.redraw(random);
    if (i < 100) continue;
    mean += residuals.log_noise() / kDraws;
    square += residuals.log_noise() * residuals.log_noise() / kDraws;
  }
  const double told = as_vector(readings.off).squaredNorm() / 200.0;
  EXPECT_NEAR(mean, 0.5 * std::log(told / 0.01), 0.01);
  EXPECT_NEAR(std::sqrt(square - mean * mean), 1.0 / std::sqrt(400.0), 0.006);
}

// Ninety of a hundred readings are what is said of them to the last digit.
TEST(OutlineResiduals, EqualReadingsTellOfNoLessNoiseThanThereIs) {
  Readings readings;
  readings.off.assign(90, 0.0);
  Random random(9);
  for (int i = 0; i < 10; ++i) readings.off.push_back(0.3 * random.normal());
  readings.variance.assign(100, 0.01);
  OutlineResiduals residuals = residuals_of(readings, {.least_log_noise = -2.0});
  double mean = 0.0;
  for (int i = 0; i < 1000; ++i) {
    residuals.redraw(random);
    ASSERT_GE(residuals.log_noise(), -2.0);
    if (i >= 500) mean += residuals.log_noise() / 500;
  }
  EXPECT_LT(mean, -1.9);
}

/// The raster with noise three times as large on its right half, which counts as tumour.
Readings noisier_on_the_right() {
  Readings readings = raster(0.01);
  readings.shares.setZero(64);
  Random random(8);
  for (std::size_t i = 0; i < 64; ++i) {
    double& share = readings.shares[static_cast<Eigen::Index>(i)];
    share = readings.places[i].x() > 10 * kMm ? 1.0 : 0.0;
    readings.off[i] = 0.1 * std::pow(3.0, share) * random.normal();
  }
  return readings;
}

// What noise has grown by changes what a reading weighs, and its own density, alike.
TEST(OutlineResiduals, WhoseNoiseGrowsAreWeighedFewAtATimeAsAllTogether) {
  const Readings readings = noisier_on_the_right();
  OutlineResiduals residuals = residuals_of(readings);
  Random random(9);
  double most = 0.0;
  for (int round = 0; round < 20; ++round) {
    residuals.redraw(random);
    most = std::max(most, residuals.growth_of_noise());
    const double before = residuals.log_density();
    for (std::size_t i = 0; i < 5; ++i)
      residuals.consider((round * 13 + i * 11) % 64, 0.2 * random.normal());
    const double change = residuals.change();
    residuals.keep();
    EXPECT_NEAR(residuals.log_density() - before, change, 1e-8);
  }
  EXPECT_GT(most, 0.1);
}

// Without a background, with noise known where nothing is felt: the posterior
// of one number, against its integral on a grid.
TEST(OutlineResiduals, LearnHowMuchMoreNoiseThereIsOnATumour) {
  Readings readings = noisier_on_the_right();
  readings.background = {};
  OutlineResiduals residuals = residuals_of(readings, {.noise_log_sd = 1e-9, .wild_density = 1e-9});
  double weights = 0.0, expected = 0.0, expected_square = 0.0;
  for (double growth = 0.0; growth < 3.0; growth += 0.001) {
    double log_weight = -std::log1p(growth * growth / (0.1 * 0.1));
    for (std::size_t i = 0; i < readings.off.size(); ++i) {
      const double log_sd = growth * readings.shares[static_cast<Eigen::Index>(i)];
      const double z = readings.off[i] / (0.1 * std::exp(log_sd));
      log_weight -= log_sd + 0.5 * z * z;
    }
    const double weight = std::exp(log_weight + 60.0);
    weights += weight;
    expected += weight * growth;
    expected_square += weight * growth * growth;
  }
  expected /= weights;
  const double expected_sd = std::sqrt(expected_square / weights - expected * expected);
  Random random(10);
  double mean = 0.0, square = 0.0;
  constexpr int kDraws = 20'000;
  for (int i = 0; i < 200 + kDraws; ++i) {
    residuals.redraw(random);
    if (i < 200) continue;
    const double growth = residuals.growth_of_noise();
    mean += growth / kDraws;
    square += growth * growth / kDraws;
  }
  EXPECT_NEAR(expected, std::log(3.0), 0.3);
  EXPECT_NEAR(mean, expected, 0.01);
  EXPECT_NEAR(std::sqrt(square - mean * mean), expected_sd, 0.01);
}

}  // namespace
}  // namespace palpation
