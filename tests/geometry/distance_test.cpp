#include "palpation/geometry/distance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "geometry/zoo.h"
#include "palpation/base/error.h"
#include "palpation/geometry/make_phantom.h"
#include "palpation/geometry/sampling.h"

namespace palpation {
namespace {

constexpr double kPi = std::numbers::pi;

Field distance_from_one(const Surface& surface, const SurfacePoint& source) {
  return distance_from(surface, std::span(&source, 1));
}

TEST(Distance, IsStraightOnAConvexPlaneAndCostsNothing) {
  const Surface plane(
      zoo::moved(zoo::jittered_square_mesh(9, 1), zoo::some_rotation(), Vec3(1.0, 2.0, 3.0)));
  const SurfacePoint source{31, Vec3(0.2, 0.3, 0.5)};
  const Field distance = distance_from_one(plane, source);
  for (int v = 0; v < plane.vertex_count(); ++v) {
    EXPECT_NEAR(distance[v], (plane.vertex(v) - plane.position(source)).norm(), 1e-14);
  }
  EXPECT_TRUE(plane.computed().empty());
}

TEST(Distance, UnfoldsAPlaneToStraightLines) {
  // A second piece far away makes the surface no convex disk, so the faces are unfolded.
  const TriangleMesh square = zoo::jittered_square_mesh(9, 1);
  const Surface two(
      zoo::together(square, zoo::moved(square, Eigen::Matrix3d::Identity(), Vec3(3.0, 0.0, 0.0))));
  const SurfacePoint source{31, Vec3(0.2, 0.3, 0.5)};
  const Field distance = distance_from_one(two, source);
  for (int v = 0; v < 100; ++v)
    EXPECT_NEAR(distance[v], (two.vertex(v) - two.position(source)).norm(),
                1e-13);  // a chain of ten unfoldings
  EXPECT_EQ(two.computed(), std::vector<std::string>{"geodesics"});
}

TEST(Distance, IsInfiniteWhereNothingLeads) {
  const TriangleMesh square = zoo::unit_square_mesh(2);
  const Surface two(
      zoo::together(square, zoo::moved(square, Eigen::Matrix3d::Identity(), Vec3(3.0, 0.0, 0.0))));
  const Field distance = distance_from_one(two, two.at_vertex(0));
  EXPECT_TRUE(distance.head(9).allFinite());
  for (int v = 9; v < 18; ++v) EXPECT_EQ(distance[v], std::numeric_limits<double>::infinity());
}

TEST(Distance, IsThatOfTheUnrolledCylinder) {
  // Sixteen flat strips unroll to a rectangle; the shorter way round counts.
  constexpr int kAround = 16, kAlong = 10;
  constexpr double kHeight = 2.0;
  const Surface cylinder(zoo::cylinder_mesh(1.0, kHeight, kAround, kAlong));
  const int source = 3 * kAround + 5;
  const Field distance = distance_from_one(cylinder, cylinder.at_vertex(source));
  const double chord = 2.0 * std::sin(kPi / kAround), step = kHeight / kAlong;
  for (int v = 0; v < cylinder.vertex_count(); ++v) {
    const int columns = std::abs(v % kAround - 5), rows = v / kAround - 3;
    const double expected = std::hypot(chord * std::min(columns, kAround - columns), step * rows);
    EXPECT_NEAR(distance[v], expected, 1e-13)
        << "vertex " << v;  // rounding along some twenty unfoldings
  }
}

TEST(Distance, ComesCloseToThatOfTheRoundCylinder) {
  const Surface cylinder(zoo::cylinder_mesh(1.0, 2.0, 48, 20));
  const Field distance = distance_from_one(cylinder, cylinder.at_vertex(0));
  for (int v = 0; v < cylinder.vertex_count(); ++v) {
    const int columns = v % 48;
    const double expected =
        std::hypot(2.0 * kPi * std::min(columns, 48 - columns) / 48.0, 0.1 * (v / 48));
    EXPECT_NEAR(
        distance[v], expected,
        0.003);  // a chord is shorter than its arc by 1 - sin(a) / a = 0.07 %, of at most pi
  }
}

TEST(Distance, StartsInsideAFaceWhereTheSourceIs) {
  // The source in the middle of a strip of the cylinder, unrolled by hand: face 0 is the lower
  // right triangle of the first cell.
  const Surface cylinder(zoo::cylinder_mesh(1.0, 1.0, 8, 4));
  const SurfacePoint source{0, Vec3(0.5, 0.2, 0.3)};
  const double chord = 2.0 * std::sin(kPi / 8.0);
  const double u = chord * 0.5, height = 0.25 * 0.3;
  const Field distance = distance_from_one(cylinder, source);
  for (int row = 0; row <= 4; ++row) {
    for (int column = -3; column <= 4; ++column) {
      EXPECT_NEAR(distance[8 * row + (column + 8) % 8],
                  std::hypot(chord * column - u, 0.25 * row - height), 1e-13);
    }
  }
}

TEST(Distance, GoesAroundTheHoleOfAnAnnulus) {
  // From the inner circle's rightmost point to the outer's leftmost: along the inner circle to the
  // tangent, then straight.
  constexpr int kAround = 90, kAcross = 8;
  const Surface annulus(zoo::annulus_mesh(0.5, 1.0, kAround, kAcross));
  const Field distance = distance_from_one(annulus, annulus.at_vertex(0));
  const double tangent = std::sqrt(1.0 - 0.25), angle = kPi - std::acos(0.5);
  EXPECT_NEAR(distance[kAcross * kAround + kAround / 2], 0.5 * angle + tangent,
              1e-3);  // the polygon's chords: (2 pi / 90)^2 / 24 of the arc
  EXPECT_EQ(annulus.computed(), std::vector<std::string>{"geodesics"});
}

TEST(Distance, NearsHalfTheGreatCircleOnASphere) {
  const Surface sphere(zoo::icosphere_mesh(3));
  const SurfacePoint source = sphere.at_vertex(0);
  const Field distance = distance_from_one(sphere, source);
  for (int v = 0; v < sphere.vertex_count(); ++v) {
    const double cosine = std::clamp(sphere.vertex(0).dot(sphere.vertex(v)), -1.0, 1.0);
    EXPECT_NEAR(distance[v], std::acos(cosine),
                0.012);  // faces of 0.14 rad lie up to 0.3 % inside the sphere, over at most pi
  }
}

TEST(Distance, KeepsTheTriangleInequalityAlongEveryEdge) {
  for (const zoo::Animal& animal : zoo::animals()) {
    const Surface surface(animal.mesh);
    const Field distance = distance_from_one(surface, {1, Vec3(0.25, 0.25, 0.5)});
    const Vec3 source = surface.position({1, Vec3(0.25, 0.25, 0.5)});
    for (int f = 0; f < surface.face_count(); ++f) {
      for (int i = 0; i < 3; ++i) {
        const int a = surface.triangle(f)[i], b = surface.triangle(f)[(i + 1) % 3];
        if (!std::isfinite(distance[a])) continue;
        const double rounding = 1e-12 * surface.diameter();
        EXPECT_LE(std::abs(distance[a] - distance[b]),
                  (surface.vertex(a) - surface.vertex(b)).norm() + rounding)
            << animal.name;
        EXPECT_GE(distance[a], (surface.vertex(a) - source).norm() - rounding)
            << animal.name << ": nothing is shorter than a straight line";
      }
    }
  }
}

TEST(Distance, IsTheSameBothWays) {
  for (const zoo::Animal& animal : zoo::animals()) {
    const Surface surface(animal.mesh);
    const int a = 0, b = surface.face_count() > 4 ? 17 : 3;
    const double there = distance_from_one(surface, surface.at_vertex(a))[b],
                 back = distance_from_one(surface, surface.at_vertex(b))[a];
    EXPECT_NEAR(there, back, 1e-12 * surface.diameter()) << animal.name;
  }
}

TEST(Distance, IsTheLeastOverTheSources) {
  for (const TriangleMesh& mesh :
       {zoo::torus_mesh(2.0, 0.7, 16, 10), zoo::jittered_square_mesh(8, 2)}) {
    const Surface surface(mesh);
    Random random(3);
    const std::vector<SurfacePoint> sources = sample_uniformly(surface, 5, random);
    Field least = distance_from_one(surface, sources[0]);
    for (const SurfacePoint& source : sources)
      least = least.cwiseMin(distance_from_one(surface, source));
    EXPECT_LT((distance_from(surface, sources) - least).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(Distance, MovesAndScalesWithTheSurface) {
  const Surface torus(zoo::torus_mesh(2.0, 0.7, 16, 10));
  const Surface small(
      zoo::moved(torus.mesh(), zoo::some_rotation(), Vec3(0.01, -0.02, 0.03), 1e-3));
  const SurfacePoint source{44, Vec3(0.1, 0.6, 0.3)};
  EXPECT_LT((distance_from_one(small, source) - 1e-3 * distance_from_one(torus, source))
                .cwiseAbs()
                .maxCoeff(),
            1e-14);
}

TEST(Distance, IsTheSameUnderOtherNumbers) {
  const TriangleMesh mesh = zoo::torus_mesh(2.0, 0.7, 16, 10);
  Random random(4);
  const std::vector<int> number = zoo::shuffled(160, random);
  const Surface torus(mesh), other(zoo::reordered(zoo::relabelled(mesh, number), random));
  const Field distance = distance_from_one(torus, torus.at_vertex(7)),
              again = distance_from_one(other, other.at_vertex(number[7]));
  for (int v = 0; v < 160; ++v) EXPECT_NEAR(again[number[v]], distance[v], 1e-12);
}

TEST(Distance, IsZeroAtASourceOnAVertexOrAnEdge) {
  const Surface torus(zoo::torus_mesh(2.0, 0.7, 16, 10));
  EXPECT_EQ(distance_from_one(torus, torus.at_vertex(33))[33], 0.0);
  const SurfacePoint middle{8, Vec3(0.5, 0.5, 0.0)};
  const int a = torus.triangle(8)[0], b = torus.triangle(8)[1];
  const double half = 0.5 * (torus.vertex(a) - torus.vertex(b)).norm();
  EXPECT_NEAR(distance_from_one(torus, middle)[a], half, 1e-15);
  EXPECT_NEAR(distance_from_one(torus, middle)[b], half, 1e-15);
}

TEST(Distance, RefusesSourcesThatAreNone) {
  const Surface square = zoo::unit_square(2);
  EXPECT_THROW(distance_from(square, {}), InvalidInput);
  EXPECT_THROW(distance_from_one(square, {8, Vec3(1.0, 0.0, 0.0)}), InvalidInput);
  EXPECT_THROW(distance_from_one(square, {0, Vec3(1.0, 1.0, 0.0)}), InvalidInput);
}

Surface phantom(const Sheet& sheet, double edge_m) {
  Random random(1);
  return Surface(make_phantom(sheet, edge_m, 0.3, random).mesh);
}

TEST(DistancesBetween, AreThoseOfUnfoldingToAPercent) {
  for (const Sheet& sheet :
       {cylinder_sheet(), dome_sheet(), saddle_sheet(), wave_sheet(), folded_sheet()}) {
    const Surface surface = phantom(sheet, 0.001);
    Random random(1);
    std::vector<SurfacePoint> places = sample_uniformly(surface, 12, random);
    places[3] = surface.at_vertex(11);
    places[7] = surface.at_vertex(surface.vertex_count() - 5);
    const Eigen::MatrixXd distances = distances_between(surface, places);
    EXPECT_EQ(distances, distances.transpose());
    for (int i : {3, 7}) {
      for (std::size_t k = 0; k < places.size(); ++k) {
        const Field exact = distance_from_one(surface, places[k]);
        const double truth = exact[i == 3 ? 11 : surface.vertex_count() - 5];
        EXPECT_NEAR(distances(i, static_cast<Eigen::Index>(k)), truth, 0.01 * truth);
      }
    }
  }
}

TEST(DistancesBetween, AreStraightOnAPlaneAndCostNothing) {
  const Surface plane(zoo::jittered_square_mesh(9, 1));
  Random random(1);
  const std::vector<SurfacePoint> places = sample_uniformly(plane, 5, random);
  const Eigen::MatrixXd distances = distances_between(plane, places);
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j)
      EXPECT_EQ(distances(i, j), (plane.position(places[static_cast<std::size_t>(i)]) -
                                  plane.position(places[static_cast<std::size_t>(j)]))
                                     .norm());
  }
  EXPECT_TRUE(plane.computed().empty());
}

TEST(DistancesBetween, AreInfiniteWhereNothingLeads) {
  const TriangleMesh bent = zoo::cylinder_mesh(1.0, 2.0, 8, 3);
  const Surface two(
      zoo::together(bent, zoo::moved(bent, Eigen::Matrix3d::Identity(), Vec3(3.0, 0.0, 0.0))));
  const std::vector<SurfacePoint> places = {two.at_vertex(0),
                                            two.at_vertex(two.vertex_count() - 1)};
  EXPECT_EQ(distances_between(two, places)(0, 1), std::numeric_limits<double>::infinity());
}

TEST(VerticesNear, LeavesOutWhatIsNearThroughSpaceOnly) {
  // Facing flanks are 1.5 mm apart, and up to 42 mm along the surface.
  const Surface folded = phantom(folded_sheet(), 0.001);
  const int vertex = folded.nearest_vertex(Vec3(0.003, 0.012, 0.0));
  const Field distance = distance_from_one(folded, folded.at_vertex(vertex));
  std::vector<int> expected;
  int in_space = 0;
  for (int v = 0; v < folded.vertex_count(); ++v) {
    if (distance[v] < 0.0025) expected.push_back(v);
    in_space += (folded.vertex(v) - folded.vertex(vertex)).norm() < 0.0025;
  }
  EXPECT_EQ(vertices_near(folded, vertex, 0.0025), expected);
  EXPECT_GT(in_space, static_cast<int>(expected.size()));
}

}  // namespace
}  // namespace palpation
