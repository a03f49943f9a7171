// Readings of any unit and offset, repeated, in any order, few at a time or by the thousand.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "belief/covariance_with.h"
#include "belief/likelihood.h"
#include "belief/look_ahead.h"
#include "belief/oracle.h"
#include "belief/sites.h"
#include "belief/tissue.h"
#include "palpation/base/error.h"
#include "palpation/base/parallel.h"
#include "palpation/belief/hyperparameters.h"

namespace palpation {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kUnknown = std::numeric_limits<double>::infinity();

double worst(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

TEST(ReadingsExtremes, AnotherUnitChangesNoBitOfTheAnswer) {
  const Surface tissue = plane(13, 21, 0.3);
  Random random(1);
  const std::vector<Palpation> readings = bumpy_readings(tissue, 40, random);
  for (const bool standardize : {false, true}) {
    const double signal = standardize ? 1.0 : 1.3, noise = standardize ? 0.1 : 0.05;
    const auto belief_in = [&](int exponent) {
      std::vector<Palpation> scaled = readings;
      for (Palpation& palpation : scaled)
        palpation.reading = std::ldexp(palpation.reading, exponent);
      const int own = standardize ? 0 : exponent;
      const Prior prior(tissue, Metric::Chart, {.signal_sd = std::ldexp(signal, own)},
                        {.sd = standardize ? 2.0 : kUnknown});
      return Belief(prior, {.noise_sd = std::ldexp(noise, own),
                            .noise_is_relative = standardize,
                            .standardize = standardize})
          .condition_on(scaled);
    };
    const Marginals here = belief_in(0).at_vertices();
    const double likelihood = belief_in(0).log_marginal_likelihood();
    for (const int exponent : {-480, -250, -30, 1, 30, 250, 480}) {  // of two: from 1e-144 to 1e144
      const Belief belief = belief_in(exponent);
      const Marginals there = belief.at_vertices();
      for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex) {
        ASSERT_EQ(std::ldexp(there.mean[vertex], -exponent), here.mean[vertex]) << exponent;
        ASSERT_EQ(std::ldexp(there.variance[vertex], -2 * exponent), here.variance[vertex])
            << exponent;
      }
      const double free = standardize ? 40.0 : 39.0;
      EXPECT_NEAR(belief.log_marginal_likelihood(), likelihood - free * exponent * std::log(2.0),
                  1e-9);
    }
  }
}

// A variance is the square of a reading's unit: beyond 1e150 there is no number for it.
TEST(ReadingsExtremes, UnitsWhoseSquareIsNoNumberAreRefusedInBothWaysToAskForThem) {
  const Surface tissue = plane(10, 20);
  for (const double unit : {1e-300, 1e-160, 1e160, 1e300}) {
    const std::vector<Palpation> readings{touch(tissue, 30, 7.0 * unit),
                                          touch(tissue, 90, 8.0 * unit)};
    EXPECT_THROW(Prior(tissue, Metric::Chart, {.signal_sd = unit}), InvalidInput);
    const Belief standardized(Prior(tissue, Metric::Chart, {}),
                              {.noise_sd = 0.1, .noise_is_relative = true, .standardize = true});
    EXPECT_THROW(standardized.condition_on(readings), InvalidInput) << unit;
  }
}

TEST(ReadingsExtremes, AnOffsetCostsTheDigitsThatItTakesAndNoMore) {
  const Surface tissue = plane(13, 21, 0.3);
  const Prior prior(tissue, Metric::Chart, {.length_m = 0.004}, {.sd = kUnknown});
  for (const double offset : {1e3, 1e6, 1e9, 1e12}) {
    Random random(2);
    std::vector<Palpation> readings = bumpy_readings(tissue, 25, random);
    for (Palpation& palpation : readings) palpation.reading += offset;
    const Belief belief = Belief(prior, {.noise_sd = 0.1}).condition_on(readings);
    const BigPosterior exact(prior, readings, 0.1 * 0.1);
    const Marginals at = belief.at_vertices();
    for (int vertex = 0; vertex < tissue.vertex_count(); vertex += 7) {
      const BigPosterior::At right = exact.at(prior.coordinates(vertex));
      EXPECT_LT(absolute_error(at.mean[vertex], right.mean), 4.0 * kEps * offset) << offset;
      EXPECT_LT(absolute_error(at.variance[vertex], right.variance), 1e-13) << offset;
    }
    // The constant is known to its last digit, and the likelihood is flat there.
    EXPECT_LT(absolute_error(belief.log_marginal_likelihood(), exact.log_likelihood()),
              1e-10 + 10.0 * (kEps * offset) * (kEps * offset));
  }
}

TEST(ReadingsExtremes, FiveHundredRepeatsAtThreePlacesAreThreePreciseReadings) {
  const Surface tissue = plane(10, 20);
  const Prior prior(tissue, Metric::Chart, {.length_m = 0.005}, {.sd = 0.0});
  Random random(3);
  std::vector<Palpation> readings, merged;
  for (const int vertex : {30, 31, 90}) {
    double sum = 0.0;
    for (int i = 0; i < 500; ++i) {
      readings.push_back(touch(tissue, vertex, 0.01 * vertex + 0.1 * random.normal()));
      sum += readings.back().reading;
    }
    merged.push_back(touch(tissue, vertex, sum / 500.0));
    merged.back().noise_variance = 0.01 / 500.0;
  }
  const Belief belief = Belief(prior, {.noise_sd = 0.1}).condition_on(readings);
  EXPECT_EQ(belief.site_count(), 3);
  const BigPosterior exact(prior, merged, 0.0);
  const Marginals at = belief.at_vertices();
  for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex) {
    const BigPosterior::At right = exact.at(prior.coordinates(vertex));
    EXPECT_LT(absolute_error(at.mean[vertex], right.mean), 1e-12);
    EXPECT_LT(absolute_error(at.variance[vertex], right.variance), 1e-12);
  }
}

/// Mean and variance at a vertex of a field of zero mean, in long double from scratch.
struct LongPosterior {
  using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  LongPosterior(const Prior& prior, const std::vector<Palpation>& readings, double noise_variance)
      : prior_(prior) {
    const auto n = static_cast<Eigen::Index>(readings.size());
    Matrix s(n, n);
    Vector y(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      places.push_back(prior.coordinates(readings[i].where));
      y[i] = readings[i].reading;
      for (Eigen::Index j = 0; j <= i; ++j) s(i, j) = correlation_of(places[i], places[j]);
      s(i, i) += noise_variance;
    }
    factor.compute(s);
    whitened = factor.matrixL().solve(y);
  }
  std::pair<long double, long double> at(const Vec3& x) const {
    Vector k(static_cast<Eigen::Index>(places.size()));
    for (std::size_t i = 0; i < places.size(); ++i)
      k[static_cast<Eigen::Index>(i)] = correlation_of(x, places[i]);
    const Vector v = factor.matrixL().solve(k);
    return {v.dot(whitened), 1.0L - v.squaredNorm()};
  }
  long double correlation_of(const Vec3& a, const Vec3& b) const {
    long double r2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const long double d =
          (static_cast<long double>(a[axis]) - b[axis]) / prior_.kernel().length_m;
      r2 += d * d;
    }
    return std::exp(-r2 / 2);
  }

  const Prior& prior_;
  std::vector<Vec3> places;
  Eigen::LLT<Matrix> factor;
  Vector whitened;
};

TEST(ReadingsExtremes, HundredsOfAppendsAreAsGoodAsOneFactorFromScratch) {
  const Surface tissue = plane(20, 40);
  Random random(4);
  const std::vector<Palpation> readings = bumpy_readings(tissue, 300, random);
  for (const double s2 : {1e-2, 1e-6, 1e-10}) {
    const Prior prior(tissue, Metric::Chart, {.length_m = 0.0033}, {.sd = 0.0});
    const Belief empty(prior, {.noise_sd = std::sqrt(s2)});
    Belief grown = empty;
    for (std::size_t i = 0; i < readings.size(); i += 5)
      grown = grown.condition_on(std::span(readings).subspan(i, 5));
    const LongPosterior exact(prior, readings, s2);
    const Marginals appended = grown.at_vertices(),
                    scratch = empty.condition_on(readings).at_vertices();
    double mean = 0.0, variance = 0.0, scratch_mean = 0.0, scratch_variance = 0.0;
    for (int vertex = 0; vertex < tissue.vertex_count(); vertex += 37) {
      const auto [right_mean, right_variance] = exact.at(prior.coordinates(vertex));
      mean = std::max(mean, std::abs(appended.mean[vertex] - static_cast<double>(right_mean)));
      scratch_mean =
          std::max(scratch_mean, std::abs(scratch.mean[vertex] - static_cast<double>(right_mean)));
      variance = std::max(
          variance, std::abs(appended.variance[vertex] - static_cast<double>(right_variance)));
      scratch_variance = std::max(scratch_variance, std::abs(scratch.variance[vertex] -
                                                             static_cast<double>(right_variance)));
    }
    // Three hundred readings within a few lengths: the covariance's own rounding moves as much,
    // from scratch too.
    EXPECT_LT(variance, 5.0 * scratch_variance + 1e-14) << s2;
    EXPECT_LT(variance, 1e-12) << s2;
    EXPECT_LT(scratch_variance, 1e-12) << s2;
    EXPECT_LT(mean, 5.0 * scratch_mean + 1e-13) << s2;
    EXPECT_LT(mean, 1e-10 / std::sqrt(s2)) << s2;
  }
}

// A place touched again has a row more, until there are too many: then what comes after is
// forgotten and made anew.
TEST(ReadingsExtremes, AThousandChangedReadingsLeaveNoTrace) {
  const Surface tissue = plane(13, 21, 0.3);
  Random random(5);
  std::vector<Palpation> readings = bumpy_readings(tissue, 30, random);
  const Belief empty(Prior(tissue, Metric::Chart, {}), {.noise_sd = 0.1});
  Belief belief = empty.condition_on(readings);
  for (int i = 0; i < 1000; ++i) {
    readings.push_back(touch(tissue, 0, 7.0 + 0.1 * random.normal()));
    readings.back().where = readings[random.below(30)].where;
    belief = belief.condition_on(std::span(readings).last(1));
  }
  const Marginals scratch = empty.condition_on(readings).at_vertices();
  EXPECT_LT(worst(belief.at_vertices().mean, scratch.mean), 1e-12);
  EXPECT_LT(worst(belief.at_vertices().variance, scratch.variance), 1e-14);
}

TEST(ReadingsExtremes, TheirOrderChangesNoMoreThanTheConditionNumberAllows) {
  const Surface tissue = plane(13, 21, 0.3);
  Random random(6);
  const std::vector<Palpation> readings = bumpy_readings(tissue, 60, random);
  for (const double s2 : {1e-2, 1e-6, 1e-10}) {
    const Belief empty(Prior(tissue, Metric::Chart, {}, {.sd = 0.0}), {.noise_sd = std::sqrt(s2)});
    const Marginals given = empty.condition_on(readings).at_vertices();
    std::vector<Palpation> shuffled = readings;
    for (std::size_t i = 1; i < shuffled.size(); ++i)
      std::swap(shuffled[i], shuffled[random.below(static_cast<int>(i) + 1)]);
    const Marginals other = empty.condition_on(shuffled).at_vertices();
    EXPECT_LT(worst(given.mean, other.mean), 100.0 * kEps * 60.0 / s2 * 8.0) << s2;
    EXPECT_LT(worst(given.variance, other.variance), 1e-14) << s2;
  }
}

TEST(ReadingsExtremes, ALookAheadNeverTellsMoreThanThereIs) {
  const Surface tissue = plane(30, 60, 0.2);
  Random random(7);
  for (const double s2 : {1e-2, 1e-8, 1e-12, 1e-13, 1e-15}) {
    const Belief belief =
        Belief(Prior(tissue, Metric::Chart, {}, {.sd = 0.0}), {.noise_sd = std::sqrt(s2)})
            .condition_on(bumpy_readings(tissue, 60, random));
    const Field variance = belief.at_vertices().variance;
    Field covariance(tissue.vertex_count());
    for (int vertex = 0; vertex < tissue.vertex_count(); vertex += 37) {
      CovarianceWith(belief, vertex)(0, tissue.vertex_count(), covariance.data());
      for (int other = 0; other < tissue.vertex_count(); ++other) {
        EXPECT_LE(covariance[other] * covariance[other],
                  variance[vertex] * variance[other] * (1.0 + 2e-12))
            << s2;
        EXPECT_GE(variance[other] - covariance[other] * covariance[other] / (variance[vertex] + s2),
                  -1e-12 * variance[other])
            << s2;
      }
    }
    // The same for touches on touches, each of which leaves no more than its noise.
    LookAhead ahead(belief, variance);
    for (int vertex = 5; vertex < tissue.vertex_count(); vertex += 200) ahead.touch(vertex, s2);
    for (int tile = 0; tile < ahead.tile_count(); ++tile) {
      ahead.bring_up_to_date(tile);
      for (std::size_t lane = 0; lane < ahead.vertices(tile).size(); ++lane) {
        const int vertex = ahead.vertices(tile)[lane];
        EXPECT_GE(ahead.variances(tile)[lane], 0.0) << s2;
        const double most = vertex % 200 == 5 ? s2 : variance[vertex];
        EXPECT_LE(ahead.variances(tile)[lane], most + 1e-12 * variance[vertex]) << s2;
      }
    }
  }
}

TEST(ReadingsExtremes, TheLikelihoodOfAThousandReadingsIsALogarithmThatNeverUnderflows) {
  const Surface tissue = plane(40, 80);
  Random random(8);
  const std::vector<Palpation> readings = bumpy_readings(tissue, 1000, random);
  const Prior prior(tissue, Metric::Chart, {.length_m = 0.002}, {.sd = 0.0});
  const double s2 = 1e-4;  // the determinant is far below 1e-308
  const double ours =
      Belief(prior, {.noise_sd = 0.01}).condition_on(readings).log_marginal_likelihood();
  Eigen::MatrixXd s(1000, 1000);
  Eigen::VectorXd y(1000);
  for (int i = 0; i < 1000; ++i) {
    y[i] = readings[i].reading;
    for (int j = 0; j < 1000; ++j)
      s(i, j) = correlation(prior.kernel(), prior.coordinates(readings[i].where) -
                                                prior.coordinates(readings[j].where));
    s(i, i) += s2;
  }
  const Eigen::LDLT<Eigen::MatrixXd> factor(s);
  EXPECT_EQ(factor.vectorD().prod(), 0.0);
  const double twin = -0.5 * (y.dot(factor.solve(y)) + factor.vectorD().array().log().sum() +
                              1000.0 * std::log(2.0 * 3.14159265358979323846));
  EXPECT_NEAR(ours / twin, 1.0, 1e-9);
}

TEST(ReadingsExtremes, WhatLearningClimbsIsAsGoodByItsInverseAsByAFactor) {
  const Surface tissue = plane(26, 51);
  Random random(4);
  const std::vector<Palpation> readings = bumpy_readings(tissue, 60, random);
  const Prior prior(tissue, Metric::Chart, {.length_m = 0.008}, {.sd = 0.0});
  for (const double s2 : {1e-4, 1e-7, 1e-10}) {
    const Big exact = BigPosterior(prior, readings, s2).log_likelihood();
    const std::vector<Site> sites = gather_sites(prior, readings);
    const Hyperparameters at{0.008, 1.0, std::sqrt(s2)};
    const double bound = 1e-10 * static_cast<double>(abs(exact));
    EXPECT_LT(absolute_error(likelihood_gradient(prior, sites, at).value, exact), bound) << s2;
    EXPECT_LT(absolute_error(log_likelihood(prior, sites, at), exact), bound) << s2;
  }
}

TEST(ReadingsExtremes, MorePlacesThanMemoryHoldsAreRefusedBeforeTheyAreModelled) {
  const Surface tissue = plane(150, 150);
  std::vector<Palpation> readings;
  for (int vertex = 0; vertex < 20001; ++vertex) readings.push_back(touch(tissue, vertex, 7.0));
  try {
    Belief(Prior(tissue, Metric::Chart, {}), {.noise_sd = 0.1}).condition_on(readings);
    FAIL() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("20001 places touched must be at most 20000"),
              std::string::npos)
        << error.what();
  }
}

TEST(ReadingsExtremes, NothingThatIsNoNumberPassesForOne) {
  const Surface tissue = plane(10, 20);
  const Belief empty(Prior(tissue, Metric::Chart, {}), {.noise_sd = 0.1});
  const double nan = std::nan("");
  for (const double wrong : {nan, kUnknown, -kUnknown}) {
    const Palpation reading = touch(tissue, 1, wrong);
    EXPECT_THROW(empty.condition_on(std::span(&reading, 1)), InvalidInput);
    EXPECT_THROW(Belief(Prior(tissue, Metric::Chart, {}), {.noise_sd = wrong}), InvalidInput);
    EXPECT_THROW(Belief(Prior(tissue, Metric::Chart, {}), {.reduced_rank_tolerance = wrong}),
                 InvalidInput);
    EXPECT_THROW(Prior(tissue, Metric::Chart, {.length_m = wrong}), InvalidInput);
    EXPECT_THROW(Prior(tissue, Metric::Chart, {.signal_sd = wrong}), InvalidInput);
    EXPECT_THROW(Prior(tissue, Metric::Chart, {}, {}, {.sd = Vec3(wrong, 0.0, 0.0)}), InvalidInput);
    const SurfacePoint nowhere{0, Vec3(wrong, 0.0, 0.0)};
    EXPECT_THROW(tissue.position(nowhere), InvalidInput);
  }
  EXPECT_THROW(Prior(tissue, Metric::Chart, {}, {.sd = nan}), InvalidInput);
  Palpation reading = touch(tissue, 1, 7.0);
  reading.noise_variance = kUnknown;
  EXPECT_THROW(empty.condition_on(std::span(&reading, 1)), InvalidInput);
}

TEST(ReadingsExtremes, ThreadsChangeNoByteHoweverLittleNoiseThereIs) {
  const Surface tissue = plane(40, 80);
  Random random(9);
  const std::vector<Palpation> readings = bumpy_readings(tissue, 100, random);
  for (const BeliefOptions& options :
       {BeliefOptions{.noise_sd = 1e-6},
        BeliefOptions{.noise_sd = 0.05, .reduced_rank_tolerance = 1e-10}}) {
    const Belief empty(Prior(tissue, Metric::Chart, {.length_m = 0.03}), options);
    set_thread_count(1);
    const Marginals one = empty.condition_on(readings).at_vertices();
    set_thread_count(4);
    const Marginals four = empty.condition_on(readings).at_vertices();
    set_thread_count(2);
    EXPECT_TRUE(one.mean == four.mean);
    EXPECT_TRUE(one.variance == four.variance);
  }
}

}  // namespace
}  // namespace palpation
