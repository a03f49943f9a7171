// The field's slope against universal kriging written out, and what it must not touch.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "belief/covariance_with.h"
#include "belief/tissue.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// A posterior of all that is uncertain: the field at the vertices, constant and slope, as one
/// normal vector z ~ N(0, S0) of which y = A z
/// + noise is known. A constant of unknown value has a standard deviation a hundred times the
/// signal's.
struct Dense {
  Eigen::VectorXd mean, component_mean, component_variance;
  Eigen::MatrixXd covariance;
};

Dense dense_posterior(const Prior& prior, const std::vector<Palpation>& palpations,
                      double noise_variance) {
  const Surface& surface = prior.surface();
  const int vertices = surface.vertex_count();
  std::vector<SurfacePoint> points;
  for (int vertex = 0; vertex < vertices; ++vertex) points.push_back(surface.at_vertex(vertex));
  Eigen::MatrixXd z = Eigen::MatrixXd::Zero(vertices + 4, vertices + 4);
  z.topLeftCorner(vertices, vertices) = prior.covariance(points, points);
  const double constant_sd =
      std::isinf(prior.constant().sd) ? 100.0 * prior.kernel().signal_sd : prior.constant().sd;
  z(vertices, vertices) = constant_sd * constant_sd;
  for (int axis = 0; axis < 3; ++axis)
    z(vertices + 1 + axis, vertices + 1 + axis) = prior.slope().sd[axis] * prior.slope().sd[axis];
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(vertices, vertices + 4);  // the field from z
  whole.leftCols(vertices).setIdentity();
  whole.col(vertices).setOnes();
  const Eigen::MatrixXd component = whole;
  for (int vertex = 0; vertex < vertices; ++vertex) {
    whole.row(vertex).tail<3>() = (prior.coordinates(vertex) - prior.slope().origin).transpose();
  }
  Eigen::MatrixXd a(palpations.size(), vertices + 4);
  Eigen::VectorXd y(palpations.size());
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    for (int vertex = 0; vertex < vertices; ++vertex) {
      if ((surface.vertex(vertex) - surface.position(palpations[i].where)).norm() == 0.0)
        a.row(i) = whole.row(vertex);
    }
    y[i] = palpations[i].reading;
  }
  Eigen::MatrixXd s = a * z * a.transpose();
  s.diagonal().array() += noise_variance;
  const Eigen::MatrixXd gain = z * a.transpose() * s.inverse();
  const Eigen::VectorXd mean = gain * y;
  const Eigen::MatrixXd covariance = z - gain * a * z;
  return {whole * mean, component * mean,
          (component * covariance * component.transpose()).diagonal(),
          whole * covariance * whole.transpose()};
}

Slope some_slope() { return {.sd = {40.0, 25.0, 0.0}, .origin = {0.0125, 0.025, 0.0}}; }

TEST(Slope, IsUniversalKrigingWithANormalPrior) {
  const Surface tissue = plane(9, 14);
  Random random(1);
  const std::vector<Palpation> readings = bumpy_readings(tissue, 40, random);
  for (const double constant_sd : {0.0, 4.0, kUnknown}) {
    const Prior prior(tissue, Metric::Chart, {.length_m = 0.004, .signal_sd = 1.3},
                      {.sd = constant_sd}, some_slope());
    const Dense dense = dense_posterior(prior, readings, 0.04);
    const Belief belief = Belief(prior, {.noise_sd = 0.2})
                              .condition_on(std::span(readings).first(17))
                              .condition_on(std::span(readings).subspan(17));
    const Marginals whole = belief.at_vertices(), component = belief.at_vertices(Part::Detrended);
    // A constant of sd 130 is not quite unknown: a mean of 7 known to 0.3 is drawn towards 0 by 7 x
    // (0.3 / 130)^2.
    const double tolerance = std::isinf(constant_sd) ? 1e-4 : 1e-9;
    EXPECT_LT((whole.mean - dense.mean).cwiseAbs().maxCoeff(), tolerance);
    EXPECT_LT((whole.variance - dense.covariance.diagonal()).cwiseAbs().maxCoeff(), tolerance);
    EXPECT_LT((component.mean - dense.component_mean).cwiseAbs().maxCoeff(), tolerance);
    EXPECT_LT((component.variance - dense.component_variance).cwiseAbs().maxCoeff(), tolerance);
    Eigen::VectorXd row(tissue.vertex_count());
    CovarianceWith(belief, 61)(0, tissue.vertex_count(), row.data());
    EXPECT_LT((row - dense.covariance.col(61)).cwiseAbs().maxCoeff(), tolerance);
  }
}

TEST(Slope, IsTheSameAtPointsAndAtVertices) {
  const Surface tissue = plane(9, 14);
  Random random(2);
  const Belief belief =
      Belief(Prior(tissue, Metric::Ambient, {.length_m = 0.005}, {}, some_slope()),
             {.noise_sd = 0.05})
          .condition_on(bumpy_readings(tissue, 20, random));
  std::vector<SurfacePoint> points;
  for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex)
    points.push_back(tissue.at_vertex(vertex));
  for (const Part part : {Part::Whole, Part::Detrended}) {
    const Marginals there = belief.at_vertices(part), here = belief.at(points, part);
    EXPECT_LT((there.mean - here.mean).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((there.variance - here.variance).cwiseAbs().maxCoeff(), 1e-9);
  }
}

// A plane added to the readings goes into the slope, but for what the slope's prior keeps back:
// with 40 readings about 1e-3 of it.
TEST(Slope, TakesUpAPlaneThatIsAddedToTheReadings) {
  const Surface tissue = plane(20, 40);
  Random random(3);
  const std::vector<Palpation> readings = bumpy_readings(tissue, 60, random);
  std::vector<Palpation> tilted = readings;
  for (Palpation& palpation : tilted)
    palpation.reading += 40.0 * tissue.position(palpation.where).y();
  const Slope wide{.sd = {1e4, 1e4, 0.0}, .origin = {0.0125, 0.025, 0.0}};
  const Belief none(Prior(tissue, Metric::Chart, {.length_m = 0.004}, {}, wide),
                    {.noise_sd = 0.05});
  const Belief flat = none.condition_on(readings), steep = none.condition_on(tilted);
  EXPECT_NEAR(steep.slope().y() - flat.slope().y(), 40.0, 0.1);
  EXPECT_NEAR(steep.slope().x() - flat.slope().x(), 0.0, 0.1);
  // The plane is 40 x (y - 25 mm) and a constant of 1, which is no part of the slope.
  const Eigen::VectorXd change =
      steep.at_vertices(Part::Detrended).mean - flat.at_vertices(Part::Detrended).mean;
  EXPECT_LT((change.array() - 1.0).abs().maxCoeff(), 2e-3);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    EXPECT_NEAR(steep.detrended_palpations()[i].reading - flat.detrended_palpations()[i].reading,
                1.0, 2e-3);
  }
}

TEST(Slope, LeavesABeliefWithoutReadingsAtItsPrior) {
  const Surface tissue = plane(9, 14);
  const Belief belief(Prior(tissue, Metric::Chart, {.signal_sd = 2.0}, {.sd = 0.0}, some_slope()),
                      {});
  const Marginals whole = belief.at_vertices();
  EXPECT_EQ(whole.mean.cwiseAbs().maxCoeff(), 0.0);
  EXPECT_NEAR(whole.variance[0], 4.0 + 0.25 + 0.390625, 1e-12);  // (40 x 12.5 mm)^2, (25 x 25 mm)^2
  EXPECT_NEAR(belief.at_vertices(Part::Detrended).variance[0], 4.0, 1e-12);
}

TEST(Slope, IsAskedForByItsChangeFromTheMiddleToTheSides) {
  const Surface tissue = plane(9, 14);
  const Slope slope = slope_across(tissue, Metric::Ambient, 1.5);
  EXPECT_NEAR(slope.sd.x(), 1.5 / 0.0125, 1e-9);
  EXPECT_NEAR(slope.sd.y(), 1.5 / 0.025, 1e-9);
  EXPECT_EQ(slope.sd.z(), 0.0);  // flat tissue has no slope along its normal
  EXPECT_NEAR((slope.origin - Vec3(0.0125, 0.025, 0.0)).norm(), 0.0, 1e-15);
}

TEST(Slope, MustBeFiniteAndNotNegative) {
  const Surface tissue = plane(4, 4);
  EXPECT_THROW(Prior(tissue, Metric::Chart, {}, {}, {.sd = {-1.0, 0.0, 0.0}}), InvalidInput);
  EXPECT_THROW(Prior(tissue, Metric::Chart, {}, {}, {.sd = {kUnknown, 0.0, 0.0}}), InvalidInput);
  EXPECT_THROW(
      Prior(tissue, Metric::Chart, {}, {}, {.sd = {1.0, 0.0, 0.0}, .origin = {kUnknown, 0.0, 0.0}}),
      InvalidInput);
}

}  // namespace
}  // namespace palpation
