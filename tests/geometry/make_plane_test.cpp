#include "palpation/geometry/make_plane.h"

#include <gtest/gtest.h>

#include <limits>

#include "palpation/base/error.h"
#include "palpation/geometry/surface.h"

namespace palpation {
namespace {

TriangleMesh plane(const PlaneOptions& options, std::uint64_t seed = 1) {
  Random random(seed);
  return make_plane(options, random);
}

TEST(MakePlane, MakesThePapersPhantomByDefault) {
  const Surface phantom(plane({}));
  EXPECT_EQ(phantom.vertex_count(), 40'000);
  EXPECT_EQ(phantom.face_count(), 79'202);
  EXPECT_EQ(phantom.vertex(0), Vec3(0.0, 0.0, 0.0));
  EXPECT_EQ(phantom.vertex(199), Vec3(0.025, 0.0, 0.0));
  EXPECT_EQ(phantom.vertex(39'800), Vec3(0.0, 0.050, 0.0));
  EXPECT_EQ(phantom.vertex(39'999), Vec3(0.025, 0.050, 0.0));
  EXPECT_NEAR(phantom.area(), 0.00125,
              1e-17);  // rounding of the coordinates, 1e-16 of a side for each of 200 columns,
                       // cancels but for a few
  EXPECT_TRUE(phantom.is_planar());
  EXPECT_TRUE(phantom.topology().is_disk());
  EXPECT_GT(phantom.face_normal(0).z(), 0.0);
}

TEST(MakePlane, StartsAtTheCornerRowByRow) {
  const TriangleMesh mesh =
      plane({.size_m = Vec2(2.0, 1.0), .columns = 3, .rows = 2, .corner_m = Vec2(10.0, -5.0)});
  Points expected(6, 3);
  expected << 10, -5, 0, 11, -5, 0, 12, -5, 0, 10, -4, 0, 11, -4, 0, 12, -4, 0;
  EXPECT_EQ(mesh.vertices, expected);
}

TEST(MakePlane, TurnsEverySecondDiagonal) {
  const TriangleMesh mesh = plane({.size_m = Vec2(2.0, 1.0), .columns = 3, .rows = 2});
  Triangles expected(4, 3);
  expected << 0, 1, 4, 0, 4, 3, 1, 2, 4, 2, 5, 4;
  EXPECT_EQ(mesh.triangles, expected);
}

TEST(MakePlane, StaysAValidRectangleUnderTheStrongestJitter) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Surface jittered(
        plane({.size_m = Vec2(3.0, 2.0), .columns = 31, .rows = 21, .jitter = 0.45}, seed));
    EXPECT_TRUE(jittered.is_planar()) << "a triangle is turned over with seed " << seed;
    EXPECT_NEAR(jittered.area(), 6.0, 1e-12) << "rounding of a sum of 1200 terms";
  }
}

TEST(MakePlane, KeepsJitteredBorderVerticesOnTheBorderAndCornersInPlace) {
  const TriangleMesh mesh =
      plane({.size_m = Vec2(1.0, 1.0), .columns = 8, .rows = 8, .jitter = 0.45});
  for (int k = 0; k < 8; ++k) {
    EXPECT_EQ(mesh.vertices(k, 1), 0.0);
    EXPECT_EQ(mesh.vertices(56 + k, 1), 1.0);
    EXPECT_EQ(mesh.vertices(8 * k, 0), 0.0);
    EXPECT_EQ(mesh.vertices(8 * k + 7, 0), 1.0);
  }
  EXPECT_NE(mesh.vertices(1, 0), 1.0 / 7.0);
}

TEST(MakePlane, JittersTheSameWayForTheSameSeed) {
  const PlaneOptions options{.columns = 10, .rows = 10, .jitter = 0.3};
  EXPECT_EQ(plane(options, 5).vertices, plane(options, 5).vertices);
  EXPECT_NE(plane(options, 5).vertices, plane(options, 6).vertices);
}

TEST(MakePlane, DrawsNothingWithoutJitter) {
  Random used(1), unused(1);
  make_plane({.columns = 4, .rows = 4}, used);
  EXPECT_EQ(used.bits(), unused.bits());
}

TEST(MakePlane, RefusesWhatIsNoPlane) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(plane({.size_m = Vec2(0.0, 1.0)}), InvalidInput);
  EXPECT_THROW(plane({.size_m = Vec2(1.0, kInfinity)}), InvalidInput);
  EXPECT_THROW(plane({.columns = 1}), InvalidInput);
  EXPECT_THROW(plane({.rows = 0}), InvalidInput);
  EXPECT_THROW(plane({.columns = 100'000, .rows = 100'000}), InvalidInput);
  EXPECT_THROW(plane({.corner_m = Vec2(0.0, kInfinity)}), InvalidInput);
  EXPECT_THROW(plane({.jitter = -0.1}), InvalidInput);
  EXPECT_THROW(plane({.jitter = 0.46}), InvalidInput);
  EXPECT_THROW(plane({.jitter = std::numeric_limits<double>::quiet_NaN()}), InvalidInput);
}

}  // namespace
}  // namespace palpation
