#include "palpation/geometry/chart.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "geometry/zoo.h"
#include "palpation/base/error.h"
#include "palpation/geometry/surface.h"

namespace palpation {
namespace {

double signed_area(const Points2& uv, const Eigen::Vector3i& t) {
  const Vec2 a = uv.row(t[0]), b = uv.row(t[1]), c = uv.row(t[2]);
  return 0.5 * ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
}

Eigen::Matrix3d rotation_about(const Vec3& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis).toRotationMatrix();
}

TEST(Chart, IsXAndYOnALevelPlane) {
  TriangleMesh mesh = zoo::jittered_square_mesh(6, 1);
  mesh.vertices.col(2).setConstant(7.0);
  const Chart chart = Surface(mesh).chart();
  EXPECT_TRUE(chart.isometric);
  EXPECT_EQ(chart.uv, mesh.vertices.leftCols<2>());
}

TEST(Chart, KeepsLengthsAndAreasOfTiltedPlanesAndRunsCounterClockwise) {
  const Surface plane(
      zoo::moved(zoo::jittered_square_mesh(6, 1), zoo::some_rotation(), Vec3(1.0, 2.0, 3.0)));
  const Points2& uv = plane.chart().uv;
  for (int v = 1; v < plane.vertex_count(); ++v) {
    EXPECT_NEAR((uv.row(v) - uv.row(0)).norm(), (plane.vertex(v) - plane.vertex(0)).norm(),
                1e-14);  // rounding of coordinates up to 4
  }
  for (int f = 0; f < plane.face_count(); ++f)
    EXPECT_NEAR(signed_area(uv, plane.triangle(f)), plane.face_area(f), 1e-14);
}

TEST(Chart, StartsAtTheVertexNearestToTheCentroidWithUAlongX) {
  // 4 x 4 cells: vertex 12 is the middle. Tilted by 30 degrees about y: x goes to (cos 30, 0, -sin
  // 30), whose projection to the plane it is itself.
  const Eigen::Matrix3d tilt = rotation_about(Vec3::UnitY(), 30.0);
  const Surface plane(zoo::moved(zoo::unit_square_mesh(4), tilt, Vec3(5.0, 0.0, 1.0)));
  const Points2& uv = plane.chart().uv;
  EXPECT_EQ(uv.row(12), Eigen::RowVector2d(0.0, 0.0));
  EXPECT_LT((uv.row(13) - Eigen::RowVector2d(0.25, 0.0)).norm(), 1e-15);
  EXPECT_LT((uv.row(17) - Eigen::RowVector2d(0.0, 0.25)).norm(), 1e-15);
}

TEST(Chart, TakesYForUWhereXIsWithinTenDegreesOfTheNormal) {
  // The square's x axis is turned to -z, its normal to x.
  const Points2 steep = Surface(zoo::moved(zoo::unit_square_mesh(4),
                                           rotation_about(Vec3::UnitY(), 81.0), Vec3::Zero()))
                            .chart()
                            .uv;
  EXPECT_LT((steep.row(17) - Eigen::RowVector2d(0.25, 0.0)).norm(), 1e-15)
      << "the square's y axis is u";
  const Points2 less = Surface(zoo::moved(zoo::unit_square_mesh(4),
                                          rotation_about(Vec3::UnitY(), 79.0), Vec3::Zero()))
                           .chart()
                           .uv;
  EXPECT_LT((less.row(13) - Eigen::RowVector2d(0.25, 0.0)).norm(), 1e-15)
      << "the square's x axis is u";
}

TEST(Chart, SeesAPlaneFromItsOutside) {
  // Turned upside down, a plane is seen from below: still counter-clockwise.
  const Surface below(
      zoo::moved(zoo::unit_square_mesh(4), rotation_about(Vec3::UnitX(), 180.0), Vec3::Zero()));
  for (int f = 0; f < below.face_count(); ++f)
    EXPECT_GT(signed_area(below.chart().uv, below.triangle(f)), 0.0);
}

TEST(Chart, IsNoneWhereASurfaceIsNotFlat) {
  const Surface cylinder(zoo::cylinder_mesh(1.0, 1.0, 12, 3));
  EXPECT_FALSE(cylinder.has_chart());
  EXPECT_THROW(cylinder.chart(), InvalidInput);
  EXPECT_TRUE(cylinder.computed().empty());
}

std::string refusal(const TriangleMesh& mesh) {
  const Surface surface(mesh);
  EXPECT_FALSE(surface.is_planar());
  EXPECT_FALSE(surface.has_chart());
  try {
    surface.chart();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

TEST(Chart, IsNoneWhereATriangleIsTurnedOver) {
  TriangleMesh mesh = zoo::unit_square_mesh(4);
  mesh.vertices.row(12) << 0.8, 0.5, 0.0;  // the middle vertex, dragged over its neighbour at 0.75
  EXPECT_NE(refusal(mesh).find("folded has no chart: triangle"), std::string::npos)
      << refusal(mesh);
  mesh.vertices.row(12) << 0.7, 0.5, 0.0;
  EXPECT_TRUE(Surface(mesh).has_chart());
}

// A disk without a slice: its border is not convex, and no two of the thousands of triangles at its
// middle can be told apart by their boxes.
TEST(Chart, OfAFanOfManyTrianglesIsThereAtOnce) {
  constexpr int kTriangles = 30000;
  TriangleMesh fan;
  fan.vertices.resize(kTriangles + 2, 3);
  fan.vertices.row(0).setZero();
  for (int i = 0; i <= kTriangles; ++i) {
    const double angle = 5.0 * i / kTriangles;
    fan.vertices.row(i + 1) << std::cos(angle), std::sin(angle), 0.0;
  }
  fan.triangles.resize(kTriangles, 3);
  for (int i = 0; i < kTriangles; ++i) fan.triangles.row(i) << 0, i + 1, i + 2;
  EXPECT_TRUE(Surface(fan).has_chart());
}

TEST(Chart, IsNoneWhereTwoSheetsLieOverEachOther) {
  const Eigen::Matrix3d same = Eigen::Matrix3d::Identity();
  const TriangleMesh square = zoo::unit_square_mesh(4);
  // Corner over corner, edges along mesh edges, vertices on vertices; and one sheet whole inside
  // the other.
  for (const Vec3& shift : {Vec3(0.5, 0.0, 0.0), Vec3(0.75, 0.75, 0.0), Vec3(0.0, 0.0, 0.0),
                            Vec3(0.1, 0.9, 0.0), Vec3(-0.999, 0.0, 0.0)}) {
    EXPECT_NE(
        refusal(zoo::together(square, zoo::moved(square, same, shift))).find("lies over itself"),
        std::string::npos);
  }
  EXPECT_NE(refusal(zoo::together(square, zoo::moved(square, same, Vec3(0.3, 0.3, 0.0), 0.1)))
                .find("lies over itself"),
            std::string::npos);
  // Side by side, corner to corner, and apart they have a chart, tilted too.
  for (const Vec3& shift :
       {Vec3(1.0, 0.0, 0.0), Vec3(1.0, 1.0, 0.0), Vec3(1.0, 0.3, 0.0), Vec3(5.0, 0.0, 0.0)}) {
    const TriangleMesh two = zoo::together(square, zoo::moved(square, same, shift));
    EXPECT_TRUE(Surface(two).has_chart());
    EXPECT_TRUE(Surface(zoo::moved(two, zoo::some_rotation(), Vec3(3.0, 1.0, 2.0))).has_chart());
  }
}

// A strip that winds around twice: every triangle runs counter-clockwise, and each place of the
// ring is covered two times.
TEST(Chart, IsNoneWhereAStripWindsAroundTwice) {
  const auto strip = [](double degrees) {
    return zoo::rolled_grid_mesh(40, 2, false, false, [=](double u, double v) {
      const double angle = -degrees / 180.0 * std::numbers::pi * u, radius = 1.0 + v;
      return Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    });
  };
  EXPECT_NE(refusal(strip(720.0)).find("lies over itself"), std::string::npos);
  EXPECT_NE(refusal(strip(361.0)).find("lies over itself"), std::string::npos);
  EXPECT_TRUE(Surface(strip(360.0)).has_chart()) << "its ends meet, and that is all";
  EXPECT_TRUE(Surface(strip(300.0)).has_chart());
  EXPECT_TRUE(Surface(zoo::annulus_mesh(0.5, 1.0, 12, 3)).has_chart());
}

TEST(ChartHash, IsFnvOfNanometres) {
  // By hand, offset basis 0xcbf29ce484222325 and prime 0x100000001b3: no bytes; and the 16 bytes of
  // (1, 0) nanometres.
  Chart chart{Points2(0, 2)};
  EXPECT_EQ(chart.hash(), "cbf29ce484222325");
  chart.uv = Points2(1, 2);
  chart.uv << 1e-9, 0.0;
  std::uint64_t state = 0xcbf29ce484222325u;
  for (int byte = 0; byte < 16; ++byte) state = (state ^ (byte == 0 ? 1u : 0u)) * 0x100000001b3u;
  EXPECT_EQ(std::stoull(chart.hash(), nullptr, 16), state);
  EXPECT_EQ(chart.hash().size(), 16u);
}

TEST(ChartHash, SeesANanometreAndNothingBelow) {
  Chart chart = zoo::unit_square(3).chart();
  const std::string hash = chart.hash();
  chart.uv(5, 1) += 1e-10;
  EXPECT_EQ(chart.hash(), hash);
  chart.uv(5, 1) += 1e-9;
  EXPECT_NE(chart.hash(), hash);
}

TEST(ChartHash, TakesNegativeAndHugeCoordinates) {
  Chart chart{Points2(1, 2)};
  chart.uv << -1e-9, 1e300;
  const std::string hash = chart.hash();
  chart.uv << 1e-9, 1e300;
  EXPECT_NE(chart.hash(), hash);
  chart.uv << -1e-9, 1e299;
  EXPECT_NE(chart.hash(), hash);
}

}  // namespace
}  // namespace palpation
