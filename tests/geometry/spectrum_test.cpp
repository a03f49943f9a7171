#include "geometry/spectrum.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "geometry/closed_forms.h"
#include "geometry/zoo.h"
#include "palpation/base/error.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

constexpr double kPi = std::numbers::pi;
double end_for(double length) { return 2.0 * std::log(1e4) / (length * length); }

/// exp(-t L) over its value on the plane, between one vertex and all others.
Field heat_from(const Spectrum& spectrum, int vertex, double length) {
  const Eigen::VectorXd weights = (-0.5 * length * length * spectrum.values()).array().exp();
  const Eigen::VectorXd weighted =
      2.0 * kPi * length * length * spectrum.at(vertex).cwiseProduct(weights);
  Field heat(spectrum.vertex_count());
  for (int other = 0; other < spectrum.vertex_count(); ++other)
    heat[other] = weighted.dot(spectrum.at(other));
  return heat;
}

struct Worst {
  double as_it_is = 0.0;
  double evened = 0.0;  ///< divided by the square root of both places' own values, as a prior is
};

Worst worst_on_torus(int columns, double length) {
  const auto torus = closed::periodic_rectangle(Vec2(1.0, 2.0), columns, 2 * columns);
  MetricMesh mesh = torus.mesh;
  flip_to_delaunay(mesh);
  const Spectrum spectrum = spectrum_of(mesh, end_for(length), mesh.vertex_count);
  const Eigen::VectorXd weights =
      2.0 * kPi * length * length * (-0.5 * length * length * spectrum.values()).array().exp();
  Field own(mesh.vertex_count);
  for (int vertex = 0; vertex < mesh.vertex_count; ++vertex)
    own[vertex] = weights.dot(spectrum.at(vertex).cwiseAbs2());
  Worst worst;
  for (int vertex = 0; vertex < mesh.vertex_count; vertex += mesh.vertex_count / 7) {
    const Field heat = heat_from(spectrum, vertex, length);
    for (int other = 0; other < mesh.vertex_count; ++other) {
      const double truth = closed::periodic_heat(torus, vertex, other, length);
      worst.as_it_is = std::max(worst.as_it_is, std::abs(heat[other] - truth));
      worst.evened = std::max(worst.evened,
                              std::abs(heat[other] / std::sqrt(own[vertex] * own[other]) - truth));
    }
  }
  return worst;
}

// Diameter 1.118, a tenth of it as length; edges of a third and a sixth of that. On 25 x 50 mm with
// edges of 0.25 mm they are an eleventh, and (6 / 11)^2 of 3.4e-3 is 1e-3.
TEST(Spectrum, GivesTheHeatKernelOfThePeriodicRectangleToSecondOrder) {
  const Worst coarse = worst_on_torus(27, 0.1118), fine = worst_on_torus(54, 0.1118);
  EXPECT_LT(fine.as_it_is, 8e-3);
  EXPECT_GT(coarse.as_it_is / fine.as_it_is, 3.0);
  EXPECT_LT(fine.evened, 3.4e-3);
  EXPECT_GT(coarse.evened / fine.evened, 3.0);
}

double worst_on_sphere(int levels, double length) {
  TriangleMesh ball = zoo::icosphere_mesh(levels);
  Random random(3);
  const double jitter = 0.15 / std::pow(2.0, levels);
  for (Eigen::Index v = 0; v < ball.vertices.rows(); ++v) {
    ball.vertices.row(v) +=
        jitter * Vec3(random.normal(), random.normal(), random.normal()).transpose();
    ball.vertices.row(v).normalize();
  }
  const Surface sphere(ball);
  const Spectrum spectrum =
      spectrum_of(extended(sphere, 0.3), end_for(length), sphere.vertex_count());
  double worst = 0.0;
  for (int vertex = 0; vertex < sphere.vertex_count(); vertex += sphere.vertex_count() / 5) {
    const Field heat = heat_from(spectrum, vertex, length);
    for (int other = 0; other < sphere.vertex_count(); ++other) {
      const double cosine = sphere.vertex(vertex).dot(sphere.vertex(other));
      worst = std::max(worst, std::abs(heat[other] - closed::sphere_heat(1.0, cosine, length)));
    }
  }
  return worst;
}

TEST(Spectrum, GivesTheHeatKernelOfTheSphereToSecondOrder) {
  const double coarse = worst_on_sphere(3, 0.314), fine = worst_on_sphere(4, 0.314);
  EXPECT_LT(fine, 2e-2);
  EXPECT_GT(coarse / fine, 3.0);
}

// The slow twin: a dense eigendecomposition of the whole.
TEST(Spectrum, IsThatOfADenseSolver) {
  const Surface square = zoo::jittered_square(25, 6);  // 676 vertices: more than are solved densely
  const MetricMesh mesh = extended(square, 0.0);
  const double length = 0.2;
  const Spectrum spectrum = spectrum_of(mesh, end_for(length), mesh.vertex_count);
  const Laplacian laplacian = laplacian_of(mesh);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(
      Eigen::MatrixXd(laplacian.stiffness), Eigen::MatrixXd(laplacian.mass));
  for (int mode = 0; mode < spectrum.rank(); ++mode) {
    EXPECT_NEAR(spectrum.values()[mode], dense.eigenvalues()[mode], 0.01 * end_for(length))
        << mode;  // the last ones are filtered least
  }
  EXPECT_GT(dense.eigenvalues()[spectrum.rank()], 0.99 * end_for(length));
  const Eigen::VectorXd weights = (-0.5 * length * length * dense.eigenvalues()).array().exp();
  for (const int vertex : {0, 13, 340}) {
    const Field all = 2.0 * kPi * length * length * dense.eigenvectors() *
                      weights.cwiseProduct(dense.eigenvectors().row(vertex).transpose());
    EXPECT_LT((heat_from(spectrum, vertex, length) - all).cwiseAbs().maxCoeff(),
              1e-3);  // at a corner four times what is left out inside
  }
}

TEST(Spectrum, IsTheSameAtAnyThreadCount) {
  const Surface square = zoo::jittered_square(25, 6);
  const int before = thread_count();
  set_thread_count(1);
  const Spectrum alone = spectrum_of(extended(square, 0.1), 500.0, square.vertex_count());
  set_thread_count(2);
  const Spectrum shared = spectrum_of(extended(square, 0.1), 500.0, square.vertex_count());
  set_thread_count(before);
  ASSERT_EQ(alone.rank(), shared.rank());
  EXPECT_EQ(alone.values(), shared.values());
  for (int vertex = 0; vertex < square.vertex_count(); vertex += 50)
    EXPECT_EQ(alone.at(vertex), shared.at(vertex));
}

// A square of side 1 with 0.3 around it: the disk swept along its border.
TEST(Margin, HasTheAreaOfThePlaneAroundAConvexPatch) {
  const Surface square = zoo::jittered_square(20, 1);
  const MetricMesh mesh = extended(square, 0.3);
  double area = 0.0;
  for (int face = 0; face < mesh.triangles.rows(); ++face) area += area_of(mesh, face);
  EXPECT_NEAR(area, 1.0 + 4 * 0.3 + kPi * 0.09, 3e-3);  // round corners are polygons
}

/// Largest difference of the normalized heat kernel from the plane's, from the vertices nearest to
/// the given places.
double worst_against_plane(const Surface& patch, double length, const std::vector<Vec3>& places) {
  const Spectrum spectrum =
      spectrum_of(extended(patch, 1.75 * length), end_for(length), patch.vertex_count());
  Field variance(patch.vertex_count());
  for (int vertex = 0; vertex < patch.vertex_count(); ++vertex) {
    const Eigen::ArrayXd modes = spectrum.at(vertex);
    variance[vertex] =
        2.0 * kPi * length * length *
        (modes.square() * (-0.5 * length * length * spectrum.values().array()).exp()).sum();
  }
  EXPECT_NEAR(variance.minCoeff(), 1.0, 0.03);
  EXPECT_NEAR(variance.maxCoeff(), 1.0, 0.03);
  double worst = 0.0;
  for (const Vec3& place : places) {
    const int vertex = patch.nearest_vertex(place);
    const Field heat = heat_from(spectrum, vertex, length);
    for (int other = 0; other < patch.vertex_count(); ++other) {
      const double ratio = (patch.vertex(other) - patch.vertex(vertex)).norm() / length;
      worst = std::max(worst, std::abs(heat[other] / std::sqrt(variance[vertex] * variance[other]) -
                                       std::exp(-0.5 * ratio * ratio)));
    }
  }
  return worst;
}

TriangleMesh without(const TriangleMesh& mesh, const std::function<bool(const Vec3&)>& is_gone) {
  std::vector<int> kept;
  for (Eigen::Index face = 0; face < mesh.triangles.rows(); ++face) {
    Vec3 middle = Vec3::Zero();
    for (int corner = 0; corner < 3; ++corner)
      middle += mesh.vertices.row(mesh.triangles(face, corner)).transpose() / 3.0;
    if (!is_gone(middle)) kept.push_back(static_cast<int>(face));
  }
  std::vector<int> number(static_cast<std::size_t>(mesh.vertices.rows()), -1);
  TriangleMesh part{Points(mesh.vertices.rows(), 3),
                    Triangles(static_cast<Eigen::Index>(kept.size()), 3)};
  int count = 0;
  for (std::size_t face = 0; face < kept.size(); ++face) {
    for (int corner = 0; corner < 3; ++corner) {
      int& here = number[mesh.triangles(kept[face], corner)];
      if (here < 0) {
        part.vertices.row(count) = mesh.vertices.row(mesh.triangles(kept[face], corner));
        here = count++;
      }
      part.triangles(static_cast<Eigen::Index>(face), corner) = here;
    }
  }
  part.vertices.conservativeResize(count, 3);
  return part;
}

// Length 0.14, edges 0.025 (0.18 of it): on the border and in its corners as inside, by the mesh's
// own error of 0.4 (h / length)^2.
TEST(Margin, LetsThePlaneGoOnBeyondItsBorder) {
  EXPECT_LT(worst_against_plane(zoo::jittered_square(40, 2), 0.14,
                                {{0, 0, 0}, {1, 1, 0}, {0.5, 0, 0}, {0, 0.2, 0}, {0.5, 0.5, 0}}),
            0.02);
}

// A corner that is cut out, and a border in zigzag: filled with what the plane has there.
TEST(Margin, FillsNotchesAsThePlaneWould) {
  const Surface corner(without(zoo::jittered_square_mesh(40, 2),
                               [](const Vec3& p) { return p.x() > 0.5 && p.y() > 0.5; }));
  EXPECT_LT(
      worst_against_plane(corner, 0.14, {{0.5, 0.5, 0}, {0.5, 0.6, 0}, {1, 0.5, 0}, {0, 0, 0}}),
      0.02);
  const Surface round(without(zoo::jittered_square_mesh(40, 2),
                              [](const Vec3& p) { return (p - Vec3(0.5, 0.5, 0)).norm() > 0.45; }));
  EXPECT_LT(worst_against_plane(round, 0.14, {{0.05, 0.5, 0}, {0.8, 0.8, 0}, {0.2, 0.8, 0}}), 0.02);
}

// What fills a bay is long and thin until it is flipped: split before, it had four times as many
// vertices as the patch.
TEST(Margin, FillsABayWithFewVertices) {
  const Surface bay(without(zoo::jittered_square_mesh(160, 2),
                            [](const Vec3& p) { return (p - Vec3(0.5, 0, 0)).norm() < 0.35; }));
  EXPECT_LT(extended(bay, 0.3).vertex_count, 3 * bay.vertex_count());
}

// A hole narrower than the margin closes; a kernel does not see it.
TEST(Margin, ClosesHoles) {
  const Surface holed(without(zoo::jittered_square_mesh(40, 2),
                              [](const Vec3& p) { return (p - Vec3(0.5, 0.5, 0)).norm() < 0.15; }));
  EXPECT_LT(worst_against_plane(holed, 0.14, {{0.35, 0.5, 0}, {0.5, 0.65, 0}, {0.3, 0.3, 0}}),
            0.02);
}

// A tube's ends go on as a tube: the variance there is that inside.
TEST(Margin, GoesOnAlongATube) {
  const Surface tube(zoo::cylinder_mesh(0.5, 1.0, 80, 26));
  const Spectrum spectrum = spectrum_of(extended(tube, 0.35), end_for(0.2), tube.vertex_count());
  Field variance(tube.vertex_count());
  for (int vertex = 0; vertex < tube.vertex_count(); ++vertex)
    variance[vertex] = heat_from(spectrum, vertex, 0.2)[vertex];
  EXPECT_LT(variance.maxCoeff() / variance.minCoeff(), 1.03);
}

TEST(Spectrum, RefusesMoreModesThanItMayHave) {
  const Surface square = zoo::jittered_square(40, 2);
  EXPECT_THROW(square.spectrum({.greatest = end_for(0.01), .margin_m = 0.0}), InvalidInput);
  EXPECT_EQ(square.spectrum({.greatest = 100.0, .margin_m = 0.1}),
            Surface(square).spectrum({.greatest = 100.0, .margin_m = 0.1}));
  EXPECT_EQ(square.computed(), std::vector<std::string>{"spectrum"});
}

// One triangle, two that do not touch, a closed ball, handles: each has its defined answer.
TEST(Spectrum, IsDefinedOnEverySurface) {
  for (const zoo::Animal& animal : zoo::animals()) {
    const Surface surface(animal.mesh);
    const double scale = surface.diameter();
    const auto spectrum =
        surface.spectrum({.greatest = end_for(0.5 * scale), .margin_m = 0.5 * scale});
    ASSERT_GE(spectrum->rank(), 1) << animal.name;
    for (int vertex = 0; vertex < surface.vertex_count(); ++vertex)
      EXPECT_TRUE(spectrum->at(vertex).allFinite()) << animal.name;
  }
}

}  // namespace
}  // namespace palpation
