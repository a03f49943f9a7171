#include "palpation/geometry/patch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "geometry/zoo.h"
#include "palpation/base/error.h"
#include "palpation/geometry/distance.h"
#include "palpation/geometry/make_phantom.h"

namespace palpation {
namespace {

TEST(Patch, IsWhatLiesWithinTheRadiusOnAPlane) {
  // 10 x 10 cells of 0.1; around the middle, vertices at most 0.25 away: 0, 1 or 2 steps each way,
  // but not (2, 2). A whole cell inside has its four corners there: 4 x 4 cells but the four at the
  // corners, and of those the triangles that leave the far corner out.
  const Surface square = zoo::unit_square(10);
  const TriangleMesh patch = patch_around(square, Vec3(0.5, 0.5, 0.2), 0.25);
  const Surface piece(patch);
  EXPECT_EQ(piece.vertex_count(), 21);
  for (int v = 0; v < 21; ++v) EXPECT_LE((piece.vertex(v) - Vec3(0.5, 0.5, 0.0)).norm(), 0.25);
  EXPECT_TRUE(piece.topology().is_disk());
  int within = 0;
  for (int f = 0; f < square.face_count(); ++f) {
    bool inside = true;
    for (int i = 0; i < 3; ++i)
      inside &= (square.vertex(square.triangle(f)[i]) - Vec3(0.5, 0.5, 0.0)).norm() <= 0.25;
    within += inside;
  }
  EXPECT_EQ(piece.face_count(), within);
  EXPECT_EQ(square.computed(), std::vector<std::string>{"search tree"});
}

TEST(Patch, KeepsTheWholeSurfaceWithinALargeRadius) {
  const TriangleMesh mesh = zoo::torus_mesh(2.0, 0.7, 16, 10);
  const TriangleMesh patch = patch_around(Surface(mesh), Vec3(3.0, 0.0, 0.0), 100.0);
  EXPECT_EQ(patch.vertices, mesh.vertices);
  EXPECT_EQ(patch.triangles, mesh.triangles);
}

TEST(Patch, MeasuresAlongTheSurfaceAndNotThroughIt) {
  // A flat box of a torus: 0.2 thick, so that the other side is near in space and half a turn away
  // on the surface.
  const Surface torus(zoo::torus_mesh(2.0, 0.1, 60, 12));
  const Surface patch(patch_around(torus, Vec3(2.0, 0.0, 0.1), 0.25));
  const Surface all(patch_around(torus, Vec3(2.0, 0.0, 0.1), 0.5));
  double lowest = 1.0;
  for (int v = 0; v < patch.vertex_count(); ++v) lowest = std::min(lowest, patch.vertex(v).z());
  EXPECT_GT(lowest, -0.1 + 1e-3) << "the other side is 0.31 away";
  EXPECT_NEAR(all.mesh().vertices.col(2).minCoeff(), -0.1, 1e-12);
}

TEST(Patch, AgreesWithDistancesOverTheWholeSurface) {
  const Surface sphere(zoo::icosphere_mesh(3));
  const SurfacePoint middle = sphere.at_vertex(100);
  const Field distance = distance_from(sphere, std::span(&middle, 1));
  for (const double radius : {0.2, 0.5, 1.5, 3.0}) {
    int within = 0;
    for (int f = 0; f < sphere.face_count(); ++f) {
      bool inside = true;
      for (int i = 0; i < 3; ++i) inside &= distance[sphere.triangle(f)[i]] <= radius;
      within += inside;
    }
    EXPECT_EQ(patch_around(sphere, sphere.vertex(100), radius).triangles.rows(), within)
        << "radius " << radius;
  }
}

TEST(Patch, KeepsOnlyThePartAroundThePoint) {
  const TriangleMesh square = zoo::unit_square_mesh(4);
  const Surface two(
      zoo::together(square, zoo::moved(square, Eigen::Matrix3d::Identity(), Vec3(1.01, 0.0, 0.0))));
  const Surface patch(patch_around(two, Vec3(0.9, 0.5, 0.0), 5.0));
  EXPECT_EQ(patch.face_count(), 32);
  EXPECT_EQ(patch.topology().components, 1);
}

TEST(Patch, IsAValidSurfaceEvenWhereItTouchesItself) {
  // A plane with two spikes, left and right of the middle vertex: without them, that has one fan
  // above and one below, joined only around the spikes.
  TriangleMesh mesh = zoo::unit_square_mesh(6);
  mesh.vertices(23, 2) = mesh.vertices(25, 2) = 10.0;
  const TriangleMesh patch = patch_around(Surface(mesh), Vec3(0.0, 0.0, 0.0), 5.0);
  ASSERT_EQ(patch.triangles.rows(), 72 - 2 * 4);
  ASSERT_EQ(patch.vertices.rows(), 49 - 2 + 1);  // no spikes, and the middle twice
  EXPECT_EQ(patch.vertices.row(23), patch.vertices.row(24));
  const Surface surface(patch);
  EXPECT_EQ(surface.topology().components, 1);
  EXPECT_EQ(surface.topology().borders, 2)
      << "the holes of both spikes are one where the middle is split";
}

TEST(Patch, RefusesARadiusThatHoldsNoTriangle) {
  const Surface square = zoo::unit_square(4);
  EXPECT_THROW(patch_around(square, Vec3(0.5, 0.5, 0.0), 0.2), InvalidInput);
  EXPECT_THROW(patch_around(Surface(zoo::icosphere_mesh(2)), Vec3(1.0, 0.0, 0.0), 0.01),
               InvalidInput);
  EXPECT_THROW(patch_around(square, Vec3(0.5, 0.5, 0.0), 0.0), InvalidInput);
  EXPECT_THROW(patch_around(square, Vec3(0.5, 0.5, 0.0), -1.0), InvalidInput);
  EXPECT_THROW(patch_around(square, Vec3(0.5, 0.5, 0.0), std::numeric_limits<double>::infinity()),
               InvalidInput);
}

TEST(PatchPassing, TakesTheTrianglesInABox) {
  // Cells of 0.1: those between 0.2 and 0.5 along x, and 0.3 and 0.4 along y.
  const Surface square = zoo::unit_square(10);
  const PatchTests tests{.box = PatchTests::Box{Vec3(0.19, 0.29, -1.0), Vec3(0.51, 0.41, 1.0)}};
  const Surface piece(patch_passing(square, tests, std::nullopt));
  EXPECT_EQ(piece.face_count(), 6);
  EXPECT_NEAR(piece.area(), 0.03, 1e-15);
}

TEST(PatchPassing, TakesWhatFacesADirection) {
  // Of a sphere's cap all up to an angle from the top: the closed form of a cap's area, within a
  // ring of triangles.
  Random random(1);
  const Surface dome(
      make_phantom(dome_sheet({.radius_m = 0.010, .reach_m = 0.025}), 0.0005, 0.3, random).mesh);
  const PatchTests tests{.facing = PatchTests::Facing{Vec3(0.0, 0.0, 7.0), 1.0}};
  const Surface piece(patch_passing(dome, tests, std::nullopt));
  const double cap = 2.0 * std::numbers::pi * 1e-4 * (1.0 - std::cos(1.0));
  EXPECT_NEAR(piece.area(), cap, 2.0 * std::numbers::pi * 0.010 * std::sin(1.0) * 0.0005);
  for (int f = 0; f < piece.face_count(); ++f) EXPECT_GE(piece.face_normal(f).z(), std::cos(1.0));
}

TEST(PatchPassing, KeepsThePartNearestToTheCentreOrTheLargest) {
  // What faces up of an S-bend: the lowest flank and half a bend, and the highest one and half a
  // bend, shortened by the box.
  Random random(1);
  const Surface folded(make_phantom(folded_sheet(), 0.001, 0.3, random).mesh);
  const PatchTests tests{.box = PatchTests::Box{Vec3(-0.01, -0.01, -0.01), Vec3(0.015, 0.1, 0.1)},
                         .facing = PatchTests::Facing{Vec3::UnitZ(), 0.5}};
  const Surface largest(patch_passing(folded, tests, std::nullopt));
  const Surface low(patch_passing(folded, tests, Vec3(0.005, 0.01, -0.001))),
      high(patch_passing(folded, tests, Vec3(0.005, 0.01, 0.004)));
  EXPECT_LT(low.mesh().vertices.col(2).maxCoeff(), 0.001);
  EXPECT_GT(high.mesh().vertices.col(2).minCoeff(), 0.002);
  EXPECT_EQ(largest.area(), std::max(low.area(), high.area()));
}

TEST(PatchPassing, RefusesTestsThatNothingPasses) {
  const Surface square = zoo::unit_square(4);
  using Box = PatchTests::Box;
  using Facing = PatchTests::Facing;
  EXPECT_THROW(
      patch_passing(square, {.box = Box{Vec3(0.0, 0.0, 1.0), Vec3(1.0, 1.0, 2.0)}}, std::nullopt),
      InvalidInput);
  EXPECT_THROW(
      patch_passing(square, {.box = Box{Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 1.0)}}, std::nullopt),
      InvalidInput);
  EXPECT_THROW(patch_passing(square, {.facing = Facing{-Vec3::UnitZ(), 0.5}}, std::nullopt),
               InvalidInput);
  EXPECT_THROW(patch_passing(square, {.facing = Facing{Vec3::Zero(), 0.5}}, std::nullopt),
               InvalidInput);
  EXPECT_THROW(patch_passing(square, {.facing = Facing{Vec3::UnitZ(), 0.0}}, std::nullopt),
               InvalidInput);
}

}  // namespace
}  // namespace palpation
