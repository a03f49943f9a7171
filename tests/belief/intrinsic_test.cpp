#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "belief/covariance_with.h"
#include "belief/likelihood.h"
#include "belief/sites.h"
#include "belief/tissue.h"
#include "geometry/zoo.h"
#include "palpation/base/error.h"
#include "palpation/base/parallel.h"
#include "palpation/belief/hyperparameters.h"

namespace palpation {
namespace {

constexpr Metric kMetrics[] = {Metric::Chart, Metric::Ambient, Metric::Intrinsic};

/// 25 x 50 mm, edges of 0.8 mm, jittered.
const Surface& tissue() {
  static const Surface surface = plane(31, 61, 0.3);
  return surface;
}

/// Points inside faces, spread over the surface.
std::vector<SurfacePoint> random_points(const Surface& surface, int count, Random& random) {
  std::vector<SurfacePoint> points;
  for (int i = 0; i < count; ++i) {
    const double a = random.uniform(), b = random.uniform();
    const Vec3 weights =
        a + b < 1.0 ? Vec3(1.0 - a - b, a, b) : Vec3(a + b - 1.0, 1.0 - a, 1.0 - b);
    points.push_back({random.below(surface.face_count()), weights / weights.sum()});
  }
  return points;
}

double worst_difference(const Kernel& kernel) {
  Random random(1);
  std::vector<SurfacePoint> points = random_points(tissue(), 150, random);
  for (const int corner : {0, 30, 15, 60 * 31, 61 * 31 - 1})
    points.push_back(tissue().at_vertex(corner));
  const Eigen::MatrixXd chart = Prior(tissue(), Metric::Chart, kernel).covariance(points, points);
  EXPECT_LT((Prior(tissue(), Metric::Ambient, kernel).covariance(points, points) - chart)
                .cwiseAbs()
                .maxCoeff(),
            1e-12);
  return (Prior(tissue(), Metric::Intrinsic, kernel).covariance(points, points) - chart)
      .cwiseAbs()
      .maxCoeff();
}

// Edges of a fifth of the length: 0.4 (h / length)^2 is 0.016. The Materns lack what their short
// waves hold too, 1 % and 4 %.
TEST(IntrinsicPrior, MeansTheSameLengthOnAPlane) {
  EXPECT_LT(worst_difference({.length_m = 0.004}), 0.016);
  EXPECT_LT(worst_difference({.family = KernelFamily::Matern52, .length_m = 0.005}), 0.026);
  EXPECT_LT(worst_difference({.family = KernelFamily::Matern32, .length_m = 0.005}), 0.056);
}

TEST(Prior, IsPositiveSemidefiniteInEveryMetric) {
  Random random(2);
  const std::vector<SurfacePoint> points = random_points(tissue(), 200, random);
  for (const Metric metric : kMetrics) {
    for (const KernelFamily family : {KernelFamily::SquaredExponential, KernelFamily::Matern52}) {
      const Eigen::MatrixXd k =
          Prior(tissue(), metric, {.family = family, .length_m = 0.005}).covariance(points, points);
      const Eigen::VectorXd values =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (k + k.transpose())).eigenvalues();
      EXPECT_GE(values[0], -1e-10 * values[199]);
    }
  }
}

// On the border, in its corners, on a tube: even before it is normalized, and one after.
TEST(IntrinsicPrior, HasTheSameVarianceEverywhere) {
  const TriangleMesh tube = zoo::cylinder_mesh(0.008, 0.03, 60, 36);
  for (const Surface& surface : {tissue(), Surface(tube)}) {
    const Prior prior(surface, Metric::Intrinsic, {.length_m = 0.004, .signal_sd = 3.0});
    Field raw = prior.raw_variance();
    std::nth_element(raw.begin(), raw.begin() + raw.size() / 2, raw.end());
    const double median = raw[raw.size() / 2];
    EXPECT_GT(raw.minCoeff(), 0.97 * median);
    EXPECT_LT(raw.maxCoeff(), 1.03 * median);
    const Field variance = Belief(prior, {.noise_sd = 0.1}).at_vertices().variance;
    EXPECT_LT((variance.array() - 9.0).abs().maxCoeff(), 1e-12);
    Random random(3);
    const std::vector<SurfacePoint> points = random_points(surface, 20, random);
    EXPECT_LT((prior.covariance(points, points).diagonal().array() - 9.0).abs().maxCoeff(), 1e-12);
  }
}

// Rows of V from features, appended in two batches, against the posterior as its equations say it.
TEST(IntrinsicBelief, IsThePosteriorOfItsCovariance) {
  Random random(4);
  const std::vector<Palpation> readings = bumpy_readings(tissue(), 40, random);
  const Prior prior(tissue(), Metric::Intrinsic, {.length_m = 0.004, .signal_sd = 0.8},
                    {.sd = 0.0});
  const Belief belief = Belief(prior, {.noise_sd = 0.05})
                            .condition_on(std::span(readings).first(25))
                            .condition_on(std::span(readings).subspan(25));
  std::vector<SurfacePoint> sites, vertices;
  Eigen::VectorXd y(40);
  for (int i = 0; i < 40; ++i) {
    sites.push_back(readings[static_cast<std::size_t>(i)].where);
    y[i] = readings[static_cast<std::size_t>(i)].reading;
  }
  for (int vertex = 0; vertex < tissue().vertex_count(); ++vertex)
    vertices.push_back(tissue().at_vertex(vertex));
  Eigen::MatrixXd s = prior.covariance(sites, sites);
  s.diagonal().array() += 0.0025;
  const Eigen::MatrixXd cross = prior.covariance(vertices, sites);
  const Eigen::MatrixXd gain = s.llt().solve(cross.transpose()).transpose();
  const Marginals marginals = belief.at_vertices();
  EXPECT_LT((marginals.mean - gain * y).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((marginals.variance.array() - (0.64 - gain.cwiseProduct(cross).rowwise().sum().array()))
                .abs()
                .maxCoeff(),
            1e-9);
  const Marginals at = belief.at(vertices);
  EXPECT_LT((at.mean - marginals.mean).cwiseAbs().maxCoeff(), 1e-9);

  const CovarianceWith with(belief, 77);
  std::vector<double> row(static_cast<std::size_t>(tissue().vertex_count()));
  with(0, tissue().vertex_count(), row.data());
  const Eigen::VectorXd posterior = prior.covariance(vertices, std::span(vertices).subspan(77, 1)) -
                                    gain * cross.row(77).transpose();
  EXPECT_LT(
      (Eigen::Map<Eigen::VectorXd>(row.data(), posterior.size()) - posterior).cwiseAbs().maxCoeff(),
      1e-9);
}

// Both flanks of a fold at one place: two sites, where the ambient metric would see one.
TEST(IntrinsicBelief, KeepsSheetsThatTouchApart) {
  const TriangleMesh two = zoo::together(zoo::unit_square_mesh(12), zoo::unit_square_mesh(12));
  const Surface sheets(two);
  const Prior prior(sheets, Metric::Intrinsic, {.length_m = 0.3});
  const int half = sheets.vertex_count() / 2;
  const std::vector<Palpation> readings = {touch(sheets, 40, 1.0), touch(sheets, 40 + half, 2.0)};
  EXPECT_EQ(gather_sites(prior, readings).size(), 2u);
  EXPECT_EQ(gather_sites(Prior(sheets, Metric::Ambient, {.length_m = 0.3}), readings).size(), 1u);
  const std::vector<SurfacePoint> one = {sheets.at_vertex(40)},
                                  other = {sheets.at_vertex(40 + half),
                                           sheets.at_vertex(41 + half)};
  EXPECT_LT(prior.covariance(one, other).cwiseAbs().maxCoeff(),
            1e-4);  // apart, so independent, up to the modes left out
}

// All lengths times 1e-3 or 1e3, and a rigid motion: the same belief.
TEST(IntrinsicBelief, DoesNotDependOnTheUnitOrTheFrame) {
  const TriangleMesh mesh = zoo::cylinder_mesh(1.0, 3.0, 40, 30);
  const auto belief_at = [&](double scale, const Eigen::Matrix3d& turn) {
    const Surface tube(zoo::moved(mesh, turn, scale * Vec3(1.0, -2.0, 0.5), scale));
    std::vector<Palpation> readings;
    for (int i = 0; i < 20; ++i) readings.push_back(touch(tube, 53 * i + 7, std::sin(i)));
    return Belief(Prior(tube, Metric::Intrinsic, {.length_m = 0.5 * scale}), {.noise_sd = 0.1})
        .condition_on(readings)
        .at_vertices();
  };
  const Marginals here = belief_at(1.0, Eigen::Matrix3d::Identity());
  for (const double scale : {1e-3, 1.0, 1e3}) {
    const Marginals there = belief_at(
        scale, scale == 1e3 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : zoo::some_rotation());
    EXPECT_LT((here.mean - there.mean).cwiseAbs().maxCoeff(), 1e-9) << scale;
    EXPECT_LT((here.variance - there.variance).cwiseAbs().maxCoeff(), 1e-9) << scale;
  }
}

// The margin's rings and the search for slow waves start where the tissue's shape says.
TEST(IntrinsicPrior, DoesNotDependOnTheNumbersOfVertices) {
  Random random(8);
  const std::vector<int> new_number = zoo::shuffled(tissue().vertex_count(), random);
  const Surface relabelled(zoo::relabelled(tissue().mesh(), new_number));
  const Prior prior(tissue(), Metric::Intrinsic, {.length_m = 0.004}),
      other(relabelled, Metric::Intrinsic, {.length_m = 0.004});
  std::vector<SurfacePoint> points, moved;
  for (int vertex = 0; vertex < tissue().vertex_count(); vertex += 31) {
    points.push_back(tissue().at_vertex(vertex));
    moved.push_back(relabelled.at_vertex(new_number[vertex]));
  }
  EXPECT_LT(
      (prior.covariance(points, points) - other.covariance(moved, moved)).cwiseAbs().maxCoeff(),
      1e-9);
}

TEST(IntrinsicBelief, IsTheSameAtAnyThreadCount) {
  Random random(5);
  const std::vector<Palpation> readings = bumpy_readings(tissue(), 30, random);
  const int before = thread_count();
  const auto believed = [&](int threads) {
    set_thread_count(threads);
    const Surface own(tissue().mesh());
    return Belief(Prior(own, Metric::Intrinsic, {.length_m = 0.005}), {.noise_sd = 0.05})
        .condition_on(readings)
        .at_vertices();
  };
  const Marginals alone = believed(1), shared = believed(2);
  set_thread_count(before);
  EXPECT_EQ(alone.mean, shared.mean);
  EXPECT_EQ(alone.variance, shared.variance);
}

TEST(IntrinsicPrior, LearnsItsLength) {
  Random random(6);
  const std::vector<Palpation> readings = bumpy_readings(tissue(), 70, random);
  const LearnOptions options{.length_median_m = 0.005};
  const Hyperparameters start{0.005, 1.0, 0.05};
  const Prior prior(tissue(), Metric::Intrinsic, {.length_m = 0.005}, {}, {},
                    lengths_to_learn(0.005));
  const Learned intrinsic = learn(prior, readings, start, options);
  const Learned chart =
      learn(Prior(tissue(), Metric::Chart, {.length_m = 0.005}), readings, start, options);
  EXPECT_NEAR(intrinsic.values.length_m / chart.values.length_m, 1.0,
              0.03);  // the mesh's error in the kernel
  EXPECT_NEAR(intrinsic.values.signal_sd / chart.values.signal_sd, 1.0, 0.06);

  const std::vector<Site> sites = gather_sites(prior, readings);
  for (const KernelFamily family :
       {KernelFamily::SquaredExponential, KernelFamily::Matern32, KernelFamily::Matern52}) {
    const Prior of_family = prior.with({.family = family, .length_m = 0.006});
    const auto value_at = [&](double length_m) {
      return likelihood_gradient(of_family, sites, {length_m, 0.9, 0.1}).value;
    };
    const double step = 1e-4;
    const double by_differences =
        (value_at(0.006 * std::exp(step)) - value_at(0.006 * std::exp(-step))) / (2.0 * step);
    EXPECT_NEAR(likelihood_gradient(of_family, sites, {0.006, 0.9, 0.1}).gradient[0],
                by_differences, 1e-4);
    EXPECT_NEAR(log_likelihood(of_family, sites, {0.006, 0.9, 0.1}), value_at(0.006), 1e-7);
  }
}

TEST(IntrinsicPrior, RefusesWhatItCannotServe) {
  const auto prior = [](const Kernel& kernel, LengthRange lengths = {}) {
    return Prior(tissue(), Metric::Intrinsic, kernel, {}, {}, lengths);
  };
  EXPECT_THROW(prior({.family = KernelFamily::Matern12}), InvalidInput);
  EXPECT_THROW(prior({.family = KernelFamily::Periodic, .period_m = 0.01}), InvalidInput);
  EXPECT_THROW(prior({.length_m = 0.0005}), InvalidInput);  // finer than the mesh
  EXPECT_THROW(prior({.length_m = 0.004}, {0.005, 0.004}), InvalidInput);
  EXPECT_THROW(prior({.length_m = 0.005}).with({.length_m = 0.0049}), InvalidInput);
  Random random(7);
  const std::vector<Palpation> readings = bumpy_readings(tissue(), 10, random);
  EXPECT_THROW(learn(prior({.length_m = 0.005}), readings, {}, {}), InvalidInput);
  try {
    prior({.length_m = 0.0005});
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("length_m = 5e-04"), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("longer length"), std::string::npos) << error.what();
  }
}

// Nothing is computed that was not asked for.
TEST(Prior, ComputesASpectrumInTheIntrinsicMetricAlone) {
  const Surface square = plane(11, 21);
  Prior(square, Metric::Ambient, {});
  EXPECT_TRUE(square.computed().empty());
  Prior(square, Metric::Intrinsic, {.length_m = 0.02});
  EXPECT_EQ(square.computed(), std::vector<std::string>{"spectrum"});
}

}  // namespace
}  // namespace palpation
