#include "certainty/wave_evidence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "palpation/base/random.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

constexpr double kLength_m = 0.03;

Surface waving_tissue() {
  Random random(0);
  return Surface(make_plane({.size_m = {0.04, 0.05}, .columns = 21, .rows = 26}, random));
}

std::vector<SurfacePoint> some_places(const Surface& surface, int count) {
  Random random(3);
  std::vector<SurfacePoint> places;
  for (int i = 0; i < count; ++i)
    places.push_back(surface.at_vertex(random.below(surface.vertex_count())));
  return places;
}

Eigen::MatrixXd covariance_of(const Surface& surface, std::span<const SurfacePoint> rows,
                              std::span<const SurfacePoint> columns) {
  return Prior(surface, Metric::Chart,
               Kernel{.family = KernelFamily::Matern52, .length_m = kLength_m}, Constant{.sd = 0.0})
      .covariance(rows, columns);
}

TEST(SlowWaves, HaveTheKernelsCovarianceToAThousandth) {
  const Surface surface = waving_tissue();
  const std::vector<SurfacePoint> places = some_places(surface, 80);
  const SlowWaves waves(surface, Metric::Chart, kLength_m, places);
  EXPECT_LT(waves.terms().cols(), 50);
  const Eigen::MatrixXd left =
      covariance_of(surface, places, places) - waves.terms() * waves.terms().transpose();
  EXPECT_LT(left.cwiseAbs().maxCoeff(), 1.001e-3);
}

/// At the vertices they are what waves at the readings tell of them.
TEST(SlowWaves, GoOnBetweenReadingsAsTheFieldsMeanDoes) {
  const Surface surface = waving_tissue();
  const std::vector<SurfacePoint> places = some_places(surface, 80);
  const SlowWaves waves(surface, Metric::Chart, kLength_m, places);
  Random random(1);
  Eigen::VectorXd coefficients(waves.terms().cols());
  for (double& one : coefficients) one = random.normal();
  const Field everywhere = waves.at_vertices(coefficients);
  const Eigen::VectorXd at_places = waves.terms() * coefficients;
  double off = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i)
    off = std::max(off, std::abs(surface.interpolate(everywhere, places[i]) -
                                 at_places[static_cast<Eigen::Index>(i)]));
  EXPECT_LT(off, 0.1);  // 3e-2 for each sd of what is left out
  std::vector<SurfacePoint> vertices;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex)
    vertices.push_back(surface.at_vertex(vertex));
  Eigen::MatrixXd covariance = covariance_of(surface, places, places);
  covariance.diagonal().array() += 1e-6;
  const Field mean = covariance_of(surface, vertices, places) * covariance.llt().solve(at_places);
  EXPECT_LT((mean - everywhere).cwiseAbs().maxCoeff(), 0.2);
}

/// Against the density of the whole covariance.
TEST(WithWaves, AreAsProbableAsTheirCovarianceSays) {
  const Surface surface = waving_tissue();
  const std::vector<SurfacePoint> places = some_places(surface, 60);
  const SlowWaves waves(surface, Metric::Chart, kLength_m, places);
  Random random(2);
  Rows rows{{}, Eigen::VectorXd(60), Eigen::MatrixXd::Constant(60, 60, 0.5)};
  rows.data.variance = Eigen::VectorXd::Constant(60, 0.04);
  for (double& one : rows.off) one = random.normal();
  const WithWaves with(rows, 0.7);
  const std::vector<WavesFound> found = with.of(waves.terms());
  ASSERT_EQ(found.size(), 4u);
  for (const WavesFound& one : found) {
    double best = -1e300;
    Eigen::VectorXd mean;
    for (const double noise : {0.005, 0.007, 0.01, 0.014, 0.02, 0.028, 0.04, 0.056, 0.08, 0.11,
                               0.16, 0.22, 0.32, 0.45, 0.64, 0.9}) {
      Eigen::MatrixXd covariance =
          rows.covariance + one.height * one.height * waves.terms() * waves.terms().transpose();
      covariance.diagonal().array() += 0.49 * noise * noise;
      const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
      const double density = -0.5 * rows.off.dot(factor.solve(rows.off)) -
                             factor.matrixLLT().diagonal().array().log().sum();
      if (density <= best) continue;
      best = density;
      mean = one.height * one.height * waves.terms().transpose() * factor.solve(rows.off);
    }
    EXPECT_NEAR(one.log_density, best, 1e-8 * std::abs(best)) << one.height;
    EXPECT_LT((one.coefficients - mean).norm(), 1e-6 * mean.norm()) << one.height;
  }
}

}  // namespace
}  // namespace palpation
