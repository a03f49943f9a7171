#include "geometry/laplacian.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/closed_forms.h"
#include "geometry/zoo.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

// A linear function's energy is its slope squared times the area; constants have none; the mass is
// the area.
TEST(Laplacian, MeasuresAreasAndSlopesExactly) {
  const Surface square = zoo::jittered_square(9, 4);
  MetricMesh mesh = metric_of(square);
  for (int pass = 0; pass < 2; ++pass) {
    const Laplacian laplacian = laplacian_of(mesh);
    const Field height = square.mesh().vertices * Vec3(3.0, 4.0, 0.0),
                ones = Field::Ones(square.vertex_count());
    EXPECT_NEAR(height.dot(laplacian.stiffness * height), 25.0, 1e-10);
    EXPECT_NEAR((laplacian.stiffness * ones).cwiseAbs().maxCoeff(), 0.0, 1e-12);
    EXPECT_NEAR(ones.dot(laplacian.mass * ones), 1.0, 1e-12);
    flip_to_delaunay(mesh);  // and as much after the flips
  }
}

// Stretched cells: weights of the wrong sign, and none after the flips.
TEST(Laplacian, HasNoNegativeWeightOnceFlipped) {
  MetricMesh mesh = closed::periodic_rectangle(Vec2(8.0, 1.0), 12, 12)
                        .mesh;  // at a border weights may be negative all the same
  const auto greatest_weight = [](const MetricMesh& of) {
    const Eigen::MatrixXd stiffness(laplacian_of(of).stiffness);
    return (stiffness - Eigen::MatrixXd(stiffness.diagonal().asDiagonal())).maxCoeff();
  };
  EXPECT_GT(greatest_weight(mesh), 0.01);
  flip_to_delaunay(mesh);
  EXPECT_LT(greatest_weight(mesh), 1e-8);
  double area = 0.0;
  for (int face = 0; face < mesh.triangles.rows(); ++face) area += area_of(mesh, face);
  EXPECT_NEAR(area, 8.0, 1e-10);
}

// Three points all but on a line: the weight that would be 1e15 is held, and all is finite.
TEST(Laplacian, HoldsWeightsOfSlivers) {
  MetricMesh::Lengths lengths(1, 3);
  lengths << 1.0, 0.5, 0.5 + 1e-15;
  Triangles one(1, 3);
  one << 0, 1, 2;
  const Laplacian laplacian = laplacian_of(glued(3, one, lengths));
  for (int k = 0; k < laplacian.stiffness.nonZeros(); ++k) {
    EXPECT_TRUE(std::isfinite(laplacian.stiffness.valuePtr()[k]));
    EXPECT_LT(std::abs(laplacian.stiffness.valuePtr()[k]), 1e9);
  }
}

TEST(MetricMesh, RefusesLengthsThatAreNone) {
  Triangles one(1, 3);
  one << 0, 1, 2;
  EXPECT_THROW(glued(3, one, MetricMesh::Lengths::Zero(1, 3)), InvalidInput);
  Triangles fan(3, 3);
  fan << 0, 1, 2, 1, 0, 3, 0, 1, 4;
  EXPECT_THROW(glued(5, fan, MetricMesh::Lengths::Ones(3, 3)), InvalidInput);
}

}  // namespace
}  // namespace palpation
