#include "palpation/geometry/sampling.h"

#include <gtest/gtest.h>

#include "geometry/zoo.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

TEST(Sampling, GivesPointsOfTheSurface) {
  for (const zoo::Animal& animal : zoo::animals()) {
    const Surface surface(animal.mesh);
    Random random(1);
    const std::vector<SurfacePoint> points = sample_uniformly(surface, 500, random);
    ASSERT_EQ(points.size(), 500u);
    for (const SurfacePoint& point : points) {
      EXPECT_GE(point.barycentric.minCoeff(), 0.0);
      EXPECT_NEAR(point.barycentric.sum(), 1.0, 4e-16);
      EXPECT_NO_THROW(surface.position(point));
    }
  }
}

TEST(Sampling, IsUniformByAreaAndNotByFace) {
  // A jittered square: cells of 1/4 by 1/4 hold 1/16 of the points each, whatever triangles they
  // are made of.
  const Surface square = zoo::jittered_square(9, 4);
  Random random(2);
  constexpr int kCount = 16'000;
  std::vector<int> in_cell(16, 0);
  for (const SurfacePoint& point : sample_uniformly(square, kCount, random)) {
    const Vec3 place = square.position(point);
    ++in_cell[4 * static_cast<int>(4.0 * place.y()) + static_cast<int>(4.0 * place.x())];
  }
  double chi_squared = 0.0;
  for (const int count : in_cell) chi_squared += (count - 1000.0) * (count - 1000.0) / 1000.0;
  EXPECT_LT(chi_squared, 44.3);  // 15 degrees of freedom: one seed in ten thousand is above
}

TEST(Sampling, IsUniformInsideATriangle) {
  // The medians cut a triangle into six parts of equal area: the order of the weights says in which
  // a point is.
  TriangleMesh mesh{Points(3, 3), Triangles(1, 3)};
  mesh.vertices << 0, 0, 0, 5, 0, 0, 1, 2, 0;
  mesh.triangles << 0, 1, 2;
  Random random(3);
  std::vector<int> in_part(8, 0);
  for (const SurfacePoint& point : sample_uniformly(Surface(mesh), 6000, random)) {
    const Vec3& b = point.barycentric;
    ++in_part[4 * (b[0] < b[1]) + 2 * (b[1] < b[2]) + (b[2] < b[0])];
  }
  double chi_squared = 0.0;
  for (const int count : in_part)
    chi_squared += count == 0 ? 0.0 : (count - 1000.0) * (count - 1000.0) / 1000.0;
  EXPECT_LT(chi_squared, 25.7);  // 5 degrees of freedom, one in ten thousand
  EXPECT_EQ(in_part[0] + in_part[7], 0);
}

TEST(Sampling, RepeatsItselfForTheSameSeed) {
  const Surface sphere(zoo::icosphere_mesh(1));
  Random first(4), second(4);
  const auto a = sample_uniformly(sphere, 20, first), b = sample_uniformly(sphere, 20, second);
  for (int k = 0; k < 20; ++k) {
    EXPECT_EQ(a[k].face, b[k].face);
    EXPECT_EQ(a[k].barycentric, b[k].barycentric);
  }
}

TEST(Sampling, TakesNoPointsButNotLess) {
  Random random(5);
  EXPECT_TRUE(sample_uniformly(zoo::unit_square(1), 0, random).empty());
  EXPECT_THROW(sample_uniformly(zoo::unit_square(1), -1, random), InvalidInput);
}

}  // namespace
}  // namespace palpation
