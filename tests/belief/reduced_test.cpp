// Beliefs of reduced rank against the exact ones.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "belief/covariance_with.h"
#include "belief/dense.h"
#include "belief/tissue.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();
constexpr double kTolerance = 1e-12;

/// Readings as a probe makes them that is drawn over the tissue in rows: inside faces, close
/// together, with noise of a hundredth.
std::vector<Palpation> scanned(const Surface& surface, int count, Random& random) {
  std::vector<Palpation> palpations;
  for (int i = 0; i < count; ++i) {
    const double along = 20.0 * (i + 0.5) / count;
    const double row = std::floor(along), x = along - row;
    const Vec3 place(0.025 * (static_cast<int>(row) % 2 == 0 ? x : 1.0 - x),
                     0.050 * (row + 0.5) / 20.0, 0.0);
    Palpation palpation;
    palpation.where = surface.project(place);
    const Vec3 p = place - Vec3(0.0115, 0.030, 0.0);
    palpation.reading =
        1.0 / (1.0 + std::exp(1400.0 * (p.norm() - 0.00625))) + 0.01 * random.normal();
    palpations.push_back(palpation);
  }
  return palpations;
}

Belief reduced_from(const Prior& prior, BeliefOptions options, double tolerance = kTolerance) {
  options.reduced_rank_tolerance = tolerance;
  return Belief(prior, options);
}

// Ten millimetres: the tissue is a few lengths wide, so that few features do.
const Kernel kSmooth{.length_m = 0.010};

TEST(ReducedRank, AgreesWithTheExactBeliefToAMillionthInEverythingThatCanBeAsked) {
  const Surface tissue = plane(30, 60, 0.3);
  Random random(1);
  const std::vector<Palpation> readings = scanned(tissue, 700, random);
  for (const double constant_sd : {0.0, 2.0, kUnknown}) {
    for (const bool sloping : {false, true}) {
      const Slope slope = sloping ? slope_across(tissue, Metric::Chart, 1.0) : Slope{};
      const Prior prior(tissue, Metric::Chart, kSmooth, {.sd = constant_sd}, slope);
      const Belief exact = Belief(prior, {.noise_sd = 0.01}).condition_on(readings);
      const Belief reduced = reduced_from(prior, {.noise_sd = 0.01}).condition_on(readings);
      ASSERT_TRUE(reduced.reduced_rank());
      EXPECT_FALSE(exact.reduced_rank());
      EXPECT_LT(reduced.reduced_rank()->rank, 350);
      for (const Part part : {Part::Whole, Part::Detrended}) {
        EXPECT_LT(worst(reduced.at_vertices(part).mean, exact.at_vertices(part).mean), 1e-6);
        EXPECT_LT(worst(reduced.at_vertices(part).variance, exact.at_vertices(part).variance),
                  1e-6);
      }
      std::vector<SurfacePoint> inside;
      for (int face = 0; face < tissue.face_count(); face += 97)
        inside.push_back({face, Vec3(0.2, 0.3, 0.5)});
      EXPECT_LT(worst(reduced.at(inside).mean, exact.at(inside).mean), 1e-6);
      EXPECT_LT(worst(reduced.at(inside).variance, exact.at(inside).variance), 1e-6);
      // Hundreds of units of log likelihood.
      EXPECT_NEAR(reduced.log_marginal_likelihood(), exact.log_marginal_likelihood(), 1e-4);
      EXPECT_LT((reduced.slope() - exact.slope()).norm(), 1e-6 * (1.0 + exact.slope().norm()));
      Field ours(tissue.vertex_count()), theirs(tissue.vertex_count());
      CovarianceWith(reduced, 777)(0, tissue.vertex_count(), ours.data());
      CovarianceWith(exact, 777)(0, tissue.vertex_count(), theirs.data());
      EXPECT_LT(worst(ours, theirs), 1e-9);
    }
  }
}

TEST(ReducedRank, TakesReadingsInOneByOneAsAllAtOnce) {
  const Surface tissue = plane(30, 60, 0.3);
  Random random(2);
  std::vector<Palpation> readings = scanned(tissue, 500, random);
  readings[450].noise_variance = 0.04;  // uneven noise
  for (std::size_t i = 460; i < 500; ++i)
    readings[i].where = readings[i - 450].where;  // places touched again
  const Prior prior(tissue, Metric::Chart, kSmooth);
  const Belief exact = Belief(prior, {.noise_sd = 0.01}).condition_on(readings);
  Belief grown =
      reduced_from(prior, {.noise_sd = 0.01}).condition_on(std::span(readings).first(400));
  ASSERT_TRUE(grown.reduced_rank());
  for (std::size_t i = 400; i < readings.size(); i += 5)
    grown = grown.condition_on(std::span(readings).subspan(i, 5));
  EXPECT_LT(worst(grown.at_vertices().mean, exact.at_vertices().mean), 1e-6);
  EXPECT_LT(worst(grown.at_vertices().variance, exact.at_vertices().variance), 1e-9);
  EXPECT_NEAR(grown.log_marginal_likelihood(), exact.log_marginal_likelihood(), 1e-4);
}

TEST(ReducedRank, LosesLessWithEverySmallerToleranceAndNeverMoreThanItSays) {
  const Surface tissue = plane(30, 60, 0.3);
  Random random(3);
  const std::vector<Palpation> readings = scanned(tissue, 600, random);
  const Prior prior(tissue, Metric::Chart, kSmooth);
  const Marginals exact = Belief(prior, {.noise_sd = 0.03}).condition_on(readings).at_vertices();
  double mean_before = kUnknown, variance_before = kUnknown;
  for (const double tolerance : {1e-9, 1e-10, 1e-11, 1e-12, 1e-13}) {
    const Belief reduced =
        reduced_from(prior, {.noise_sd = 0.04}, tolerance).condition_on(readings);
    ASSERT_TRUE(reduced.reduced_rank()) << tolerance;
  }
  for (const double tolerance : {8e-10, 1e-10, 1e-11, 1e-12}) {
    const Belief reduced =
        reduced_from(prior, {.noise_sd = 0.03}, tolerance).condition_on(readings);
    ASSERT_TRUE(reduced.reduced_rank()) << tolerance;
    const double mean = worst(reduced.at_vertices().mean, exact.mean),
                 variance = worst(reduced.at_vertices().variance, exact.variance);
    EXPECT_LT(mean, mean_before);
    EXPECT_LT(variance, variance_before);
    EXPECT_LT(mean, reduced.reduced_rank()->mean_error);
    EXPECT_LT(variance, reduced.reduced_rank()->variance_error + 1e-13);  // rounding on top
    mean_before = mean;
    variance_before = variance;
  }
}

TEST(ReducedRank, LeavesToTheExactBeliefWhatItCannotDo) {
  const Surface tissue = plane(30, 60, 0.3);
  Random random(4);
  const std::vector<Palpation> readings = scanned(tissue, 300, random);
  const Prior smooth(tissue, Metric::Chart, kSmooth);
  // Few readings; readings sharper than the tolerance allows; a kernel so rough that features would
  // be no fewer than readings.
  EXPECT_FALSE(reduced_from(smooth, {.noise_sd = 0.01})
                   .condition_on(std::span(readings).first(50))
                   .reduced_rank());
  EXPECT_FALSE(reduced_from(smooth, {.noise_sd = 1e-4}).condition_on(readings).reduced_rank());
  const Prior rough(tissue, Metric::Chart, {.family = KernelFamily::Matern32, .length_m = 0.005});
  EXPECT_FALSE(reduced_from(rough, {.noise_sd = 0.01}).condition_on(readings).reduced_rank());

  // One sharp reading later on: exact again.
  const Belief before = reduced_from(smooth, {.noise_sd = 0.01}).condition_on(readings);
  ASSERT_TRUE(before.reduced_rank());
  Palpation sharp = touch(tissue, 100, 0.5);
  sharp.noise_variance = 1e-8;
  const Belief after = before.condition_on(std::span(&sharp, 1));
  EXPECT_FALSE(after.reduced_rank());
  std::vector<Palpation> all = readings;
  all.push_back(sharp);
  const Belief exact = Belief(smooth, {.noise_sd = 0.01}).condition_on(all);
  EXPECT_TRUE(after.at_vertices().mean == exact.at_vertices().mean);
  EXPECT_TRUE(after.at_vertices().variance == exact.at_vertices().variance);

  EXPECT_THROW(reduced_from(smooth, {}, -1.0), InvalidInput);
  EXPECT_THROW(reduced_from(smooth, {}, 1e-15), InvalidInput);
}

TEST(ReducedRank, CoversPlacesInsideFacesThatTheVerticesDoNot) {
  const Surface coarse = plane(4, 5);  // twelve faces' middles lie a length from any vertex
  Random random(5);
  const std::vector<Palpation> readings = scanned(coarse, 400, random);
  const Prior prior(coarse, Metric::Chart, kSmooth);
  const Belief exact = Belief(prior, {.noise_sd = 0.01}).condition_on(readings);
  Belief reduced =
      reduced_from(prior, {.noise_sd = 0.01}).condition_on(std::span(readings).first(300));
  ASSERT_TRUE(reduced.reduced_rank());
  for (std::size_t i = 300; i < 400; i += 20)
    reduced = reduced.condition_on(std::span(readings).subspan(i, 20));
  ASSERT_TRUE(reduced.reduced_rank());
  expect_alike(reduced.at_vertices(), exact.at_vertices(), 1e-6);
}

TEST(ReducedRank, StandardizesAsTheExactBeliefDoes) {
  const Surface tissue = plane(30, 60, 0.3);
  Random random(6);
  const std::vector<Palpation> readings = scanned(tissue, 420, random);
  for (const bool relative : {false, true}) {
    const BeliefOptions options{
        .noise_sd = 0.05, .noise_is_relative = relative, .standardize = true};
    const Prior prior(tissue, Metric::Chart, kSmooth, {.sd = 1.0});
    const Belief exact = Belief(prior, options).condition_on(readings);
    Belief reduced = reduced_from(prior, options).condition_on(std::span(readings).first(400));
    reduced = reduced.condition_on(std::span(readings).subspan(400));
    ASSERT_TRUE(reduced.reduced_rank());
    expect_alike(reduced.at_vertices(), exact.at_vertices(), 1e-6);
  }
}

TEST(ReducedRank, ServesTheIntrinsicMetricToo) {
  const Surface tissue = plane(30, 60, 0.3);
  Random random(7);
  const std::vector<Palpation> readings = scanned(tissue, 400, random);
  const Prior prior(tissue, Metric::Intrinsic, kSmooth);
  const Belief exact = Belief(prior, {.noise_sd = 0.01}).condition_on(readings);
  const Belief reduced = reduced_from(prior, {.noise_sd = 0.01}).condition_on(readings);
  ASSERT_TRUE(reduced.reduced_rank());
  expect_alike(reduced.at_vertices(), exact.at_vertices(), 1e-6);
}

}  // namespace
}  // namespace palpation
