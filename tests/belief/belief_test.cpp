#include "palpation/belief/belief.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "belief/covariance_with.h"
#include "belief/dense.h"
#include "belief/tissue.h"
#include "palpation/base/error.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

TEST(Belief, AgreesWithScikitLearnOnTwentyRandomScenes) {
  std::ifstream file(PALPATION_SOURCE_DIR "/tests/belief/sklearn_reference.txt");
  ASSERT_TRUE(file) << "the reference values are part of the sources";
  // Two triangles that span the phantom: the places are points inside faces.
  const Surface tissue = plane(2, 2);
  const auto point_at = [&](double u, double v) {
    for (int face = 0; face < tissue.face_count(); ++face) {
      const Eigen::Vector3i t = tissue.triangle(face);
      Eigen::Matrix3d corners;
      for (int i = 0; i < 3; ++i)
        corners.col(i) = Vec3(tissue.vertex(t[i]).x(), tissue.vertex(t[i]).y(), 1.0);
      const Vec3 weights = corners.inverse() * Vec3(u, v, 1.0);
      if (weights.minCoeff() >= -1e-12) return SurfacePoint{face, weights};
    }
    throw std::logic_error("outside");
  };
  std::string word, family;
  int scenes = 0;
  double length = 0.0, signal = 0.0, noise = 0.0;
  int n = 0, m = 0;
  while (file >> word >> family >> length >> signal >> noise >> n >> m) {
    ++scenes;
    Kernel kernel{.length_m = length, .signal_sd = signal};
    if (family == "matern-1/2") kernel.family = KernelFamily::Matern12;
    if (family == "matern-3/2") kernel.family = KernelFamily::Matern32;
    if (family == "matern-5/2") kernel.family = KernelFamily::Matern52;
    std::vector<Palpation> palpations(n);
    double u = 0.0, v = 0.0;
    for (Palpation& palpation : palpations) {
      file >> u >> v >> palpation.reading;
      palpation.where = point_at(u, v);
    }
    std::vector<SurfacePoint> queries;
    Eigen::VectorXd mean(m), variance(m);
    for (int i = 0; i < m; ++i) {
      file >> u >> v >> mean[i] >> variance[i];
      queries.push_back(point_at(u, v));
    }
    const Belief belief =
        Belief(Prior(tissue, Metric::Chart, kernel, {.sd = 0.0}), {.noise_sd = std::sqrt(noise)})
            .condition_on(palpations);
    const Marginals ours = belief.at(queries);
    // In units of the signal: condition numbers below 1e7 leave 1e-9.
    EXPECT_LT(worst(ours.mean, mean) / signal, 1e-8) << "scene " << scenes;
    EXPECT_LT(worst(ours.variance, variance) / (signal * signal), 1e-8) << "scene " << scenes;
  }
  EXPECT_EQ(scenes, 20);
}

TEST(Belief, EqualsTheDenseFormulasForEveryKernelMetricAndConstant) {
  const Surface tissue = plane(13, 21, 0.3);
  Random random(1);
  for (const KernelFamily family :
       {KernelFamily::SquaredExponential, KernelFamily::Matern12, KernelFamily::Matern32,
        KernelFamily::Matern52, KernelFamily::Periodic}) {
    for (const Metric metric : {Metric::Chart, Metric::Ambient}) {
      if (family == KernelFamily::Periodic && metric == Metric::Ambient) continue;
      for (const double constant_sd : {0.0, 3.0, kUnknown}) {
        const Prior prior(tissue, metric,
                          {.family = family, .length_m = 0.004, .signal_sd = 1.5, .period_m = 0.06},
                          {.sd = constant_sd});
        std::vector<Palpation> readings = bumpy_readings(tissue, 30, random);
        readings[3].noise_variance = 0.5;  // uneven noise
        const Belief belief = Belief(prior, {.noise_sd = 0.1}).condition_on(readings);
        const Dense dense = dense_posterior(prior, readings, 0.01);
        const Marginals ours = belief.at_vertices();
        EXPECT_LT(worst(ours.mean, dense.mean),
                  1e-9);  // condition number about 1e4, readings about 10
        EXPECT_LT(worst(ours.variance, dense.variance), 1e-10);
        EXPECT_NEAR(belief.log_marginal_likelihood(), dense.log_likelihood, 1e-8);
      }
    }
  }
}

TEST(Belief, PredictsTheSameAtAVertexFromTheCacheAndFromScratch) {
  const Surface tissue = plane(13, 21, 0.3);
  Random random(2);
  const Belief belief = Belief(Prior(tissue, Metric::Chart, {.length_m = 0.004}), {.noise_sd = 0.1})
                            .condition_on(bumpy_readings(tissue, 40, random));
  std::vector<SurfacePoint> vertices;
  for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex)
    vertices.push_back(tissue.at_vertex(vertex));
  EXPECT_LT(worst(belief.at_vertices().mean, belief.at(vertices).mean), 1e-12);
  EXPECT_LT(worst(belief.at_vertices().variance, belief.at(vertices).variance), 1e-12);
}

TEST(Belief, AppendingReadingsOneByOneEqualsTakingThemAllAtOnce) {
  const Surface tissue = plane(20, 40);
  Random random(3);
  const std::vector<Palpation> readings = bumpy_readings(tissue, 60, random);
  for (const bool standardize : {false, true}) {
    const Prior prior(tissue, Metric::Chart, {.signal_sd = standardize ? 5.0 : 1.0},
                      {.sd = standardize ? 7.0 : kUnknown});
    const Belief empty(
        prior, {.noise_sd = 0.2, .noise_is_relative = standardize, .standardize = standardize});
    const Belief at_once = empty.condition_on(readings);
    Belief grown = empty;
    for (std::size_t i = 0; i < readings.size(); i += 7)
      grown = grown.condition_on(std::span(readings).subspan(i, std::min<std::size_t>(7, 60 - i)));
    EXPECT_LT(worst(grown.at_vertices().mean, at_once.at_vertices().mean), 1e-11);
    EXPECT_LT(worst(grown.at_vertices().variance, at_once.at_vertices().variance), 1e-12);
    EXPECT_NEAR(grown.log_marginal_likelihood(), at_once.log_marginal_likelihood(), 1e-9);
  }
}

TEST(Belief, DoesNotDependOnTheOrderOfReadings) {
  const Surface tissue = plane(20, 40);
  Random random(4);
  std::vector<Palpation> readings = bumpy_readings(tissue, 40, random);
  const Belief empty(Prior(tissue, Metric::Chart, {}), {.noise_sd = 0.1});
  const Belief forward = empty.condition_on(readings);
  std::reverse(readings.begin(), readings.end());
  const Belief backward = empty.condition_on(readings);
  EXPECT_LT(worst(forward.at_vertices().mean, backward.at_vertices().mean), 1e-11);
  EXPECT_LT(worst(forward.at_vertices().variance, backward.at_vertices().variance), 1e-12);
}

TEST(Belief, MergesRepeatedTouchesExactly) {
  const Surface tissue = plane(10, 20);
  const Prior prior(tissue, Metric::Chart, {.length_m = 0.005});
  std::vector<Palpation> readings{touch(tissue, 30, 7.1), touch(tissue, 90, 8.0),
                                  touch(tissue, 30, 7.3), touch(tissue, 31, 7.2),
                                  touch(tissue, 30, 6.9)};
  readings[4].noise_variance = 0.04;
  const Belief belief = Belief(prior, {.noise_sd = 0.1}).condition_on(readings);
  EXPECT_EQ(belief.site_count(), 3);
  const Dense dense =
      dense_posterior(prior, readings, 0.01);  // five rows, three of them at one place
  EXPECT_LT(worst(belief.at_vertices().mean, dense.mean), 1e-11);
  EXPECT_LT(worst(belief.at_vertices().variance, dense.variance), 1e-12);
  EXPECT_NEAR(belief.log_marginal_likelihood(), dense.log_likelihood, 1e-10);

  Belief later = Belief(prior, {.noise_sd = 0.1}).condition_on(std::span(readings).first(2));
  later = later.condition_on(std::span(readings).subspan(2));
  EXPECT_LT(worst(later.at_vertices().mean, dense.mean), 1e-11);
}

TEST(Belief, CopiesAreIndependentThoughTheyShare) {
  const Surface tissue = plane(20, 40);
  Random random(5);
  const Belief belief = Belief(Prior(tissue, Metric::Chart, {}), {.noise_sd = 0.1})
                            .condition_on(bumpy_readings(tissue, 20, random));
  const Marginals before = belief.at_vertices();
  const Palpation supposed = touch(tissue, 411, 9.0);
  const Belief other = belief.condition_on(std::span(&supposed, 1));
  EXPECT_EQ(worst(belief.at_vertices().mean, before.mean), 0.0);
  EXPECT_GT(worst(other.at_vertices().mean, before.mean), 0.01);
  EXPECT_TRUE((other.at_vertices().variance.array() <= before.variance.array() + 1e-15).all());
}

TEST(Belief, KeepsItsDigitsAtATouchedSiteWithoutMuchNoise) {
  const Surface tissue = plane(10, 20);
  for (const double noise_variance : {1e-2, 1e-6, 1e-12, 1e-15, 1e-30}) {
    const Palpation one = touch(tissue, 55, 1.0);
    const Belief belief = Belief(Prior(tissue, Metric::Chart, {}, {.sd = 0.0}),
                                 {.noise_sd = std::sqrt(noise_variance)})
                              .condition_on(std::span(&one, 1));
    // n = 1: variance = s / (1 + s) in closed form; the square root above costs one rounding, the
    // merge another.
    EXPECT_NEAR(belief.at_vertices().variance[55] / (noise_variance / (1.0 + noise_variance)), 1.0,
                1e-11)
        << noise_variance;
  }
}

TEST(Belief, WithoutReadingsIsThePrior) {
  const Surface tissue = plane(10, 20);
  const Belief belief(Prior(tissue, Metric::Chart, {.signal_sd = 3.0}), {.noise_sd = 0.1});
  EXPECT_EQ(belief.at_vertices().mean.cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(belief.at_vertices().variance.minCoeff(), 9.0);
  EXPECT_EQ(belief.at_vertices().variance.maxCoeff(), 9.0);
}

TEST(Belief, CovarianceWithAVertexIsWhatATouchThereWouldRemove) {
  const Surface tissue = plane(13, 21, 0.2);
  Random random(6);
  for (const double constant_sd : {0.0, 2.0, kUnknown}) {
    const Belief belief =
        Belief(Prior(tissue, Metric::Chart, {.signal_sd = 1.5}, {.sd = constant_sd}),
               {.noise_sd = 0.1})
            .condition_on(bumpy_readings(tissue, 30, random));
    const int vertex = 100;
    Field covariance(tissue.vertex_count());
    CovarianceWith(belief, vertex)(0, tissue.vertex_count(), covariance.data());
    const Marginals before = belief.at_vertices();
    EXPECT_NEAR(covariance[vertex], before.variance[vertex], 1e-12);
    const Palpation supposed = touch(tissue, vertex, 8.0);
    const Field after = belief.condition_on(std::span(&supposed, 1)).at_vertices().variance;
    const Field removed =
        covariance.array().square() / (before.variance[vertex] + belief.noise_variance());
    EXPECT_LT(worst(before.variance - removed, after), 1e-11);
  }
}

TEST(Belief, GivesTheSameBytesAtOneAndAtTwoThreads) {
  const Surface tissue = plane(60, 120);
  Random random(8);
  const std::vector<Palpation> readings = bumpy_readings(tissue, 50, random);
  const Belief empty(Prior(tissue, Metric::Chart, {}), {.noise_sd = 0.1});
  set_thread_count(1);
  const Marginals one = empty.condition_on(readings).at_vertices();
  set_thread_count(2);
  const Marginals two = empty.condition_on(readings).at_vertices();
  EXPECT_TRUE(one.mean == two.mean);
  EXPECT_TRUE(one.variance == two.variance);
}

TEST(Belief, IgnoresReadingsThatAreSetAside) {
  const Surface tissue = plane(10, 20);
  std::vector<Palpation> readings{touch(tissue, 30, 7.0), touch(tissue, 90, 8.0),
                                  touch(tissue, 60, 1e6)};
  readings[2].set_aside = "jam";
  const Belief empty(Prior(tissue, Metric::Chart, {}), {.noise_sd = 0.1});
  const Belief with = empty.condition_on(readings);
  EXPECT_EQ(with.palpations().size(), 3u);
  EXPECT_TRUE(with.at_vertices().mean ==
              empty.condition_on(std::span(readings).first(2)).at_vertices().mean);
}

TEST(Belief, RefusesWhatIsNoReading) {
  const Surface tissue = plane(10, 20);
  const Belief empty(Prior(tissue, Metric::Chart, {}), {.noise_sd = 0.1});
  const auto message = [&](const Palpation& palpation) -> std::string {
    try {
      empty.condition_on(std::span(&palpation, 1));
      return "accepted";
    } catch (const InvalidInput& error) {
      return error.what();
    }
  };
  EXPECT_EQ(message(touch(tissue, 1, std::nan(""))),
            "Belief: palpation 0: reading nan must be finite");
  Palpation negative = touch(tissue, 1, 1.0);
  negative.noise_variance = -1.0;
  EXPECT_EQ(message(negative),
            "Belief: palpation 0: noise variance -1 must be finite and not negative");
  EXPECT_THROW(Belief(Prior(tissue, Metric::Chart, {.length_m = 0.0}), {}), InvalidInput);
  EXPECT_THROW(Prior(tissue, Metric::Ambient, {.family = KernelFamily::Periodic, .period_m = 0.1}),
               InvalidInput);
}

TEST(Belief, SaysWhichSitesContradictEachOtherWithoutNoise) {
  const Surface tissue = plane(10, 20);
  const Belief exact(Prior(tissue, Metric::Chart, {.length_m = 100.0}), {.noise_sd = 0.0});
  const std::vector<Palpation> twice{touch(tissue, 30, 7.0), touch(tissue, 30, 7.5)};
  EXPECT_THROW(exact.condition_on(twice), InvalidInput);
  // Two hundred sites of a field that is constant to fifteen digits have no positive definite
  // covariance.
  std::vector<Palpation> dense;
  for (int vertex = 0; vertex < 200; ++vertex) dense.push_back(touch(tissue, vertex, 7.0));
  EXPECT_THROW(exact.condition_on(dense), NumericalError);
}

TEST(Belief, StandardizedIsTheZScoredModel) {
  const Surface tissue = plane(20, 40);
  Random random(9);
  std::vector<Palpation> readings = bumpy_readings(tissue, 40, random);
  const Belief raw = Belief(Prior(tissue, Metric::Chart, {.signal_sd = 5.0}, {.sd = 7.0}),
                            {.noise_sd = 0.2, .noise_is_relative = true, .standardize = true})
                         .condition_on(readings);
  double mean = 0.0, square = 0.0;
  for (const Palpation& palpation : readings) mean += palpation.reading / 40.0;
  for (const Palpation& palpation : readings)
    square += (palpation.reading - mean) * (palpation.reading - mean) / 40.0;
  const double sd = std::sqrt(square);
  for (Palpation& palpation : readings) palpation.reading = (palpation.reading - mean) / sd;
  const Belief scored =
      Belief(Prior(tissue, Metric::Chart, {.signal_sd = 5.0}, {.sd = 7.0}), {.noise_sd = 1.0})
          .condition_on(readings);
  EXPECT_LT(worst(raw.at_vertices().mean, (scored.at_vertices().mean.array() * sd + mean).matrix()),
            1e-11);
  EXPECT_LT(worst(raw.at_vertices().variance, scored.at_vertices().variance * sd * sd), 1e-11);
}

}  // namespace
}  // namespace palpation
