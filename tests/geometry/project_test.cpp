#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "geometry/zoo.h"
#include "palpation/base/error.h"
#include "palpation/geometry/sampling.h"
#include "palpation/geometry/surface.h"

namespace palpation {
namespace {

/// Distance to a triangle by Voronoi regions (Ericson 2005, 5.1.5): another way than the library's.
double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp),
               d6 = ac.dot(cp);
  if (d1 <= 0.0 && d2 <= 0.0) return ap.norm();
  if (d3 >= 0.0 && d4 <= d3) return bp.norm();
  if (d6 >= 0.0 && d5 <= d6) return cp.norm();
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return (ap - d1 / (d1 - d3) * ab).norm();
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return (ap - d2 / (d2 - d6) * ac).norm();
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return (bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b)).norm();
  return std::abs(ab.cross(ac).normalized().dot(ap));
}

double distance_by_brute_force(const Surface& surface, const Vec3& place) {
  double least = std::numeric_limits<double>::infinity();
  for (int f = 0; f < surface.face_count(); ++f) {
    const Eigen::Vector3i t = surface.triangle(f);
    least = std::min(least, distance_to_triangle(place, surface.vertex(t[0]), surface.vertex(t[1]),
                                                 surface.vertex(t[2])));
  }
  return least;
}

Vec3 somewhere_around(const Surface& surface, Random& random) {
  const Vec3 low = surface.mesh().vertices.colwise().minCoeff(),
             high = surface.mesh().vertices.colwise().maxCoeff();
  const Vec3 share(random.uniform(), random.uniform(), random.uniform());
  return 0.5 * (low + high) + surface.diameter() * (share - Vec3::Constant(0.5));
}

void expect_weights(const SurfacePoint& point) {
  EXPECT_GE(point.barycentric.minCoeff(), 0.0);
  EXPECT_NEAR(point.barycentric.sum(), 1.0, 4e-16);  // two additions
}

TEST(Project, FindsWhatASearchOfAllFacesFinds) {
  for (const zoo::Animal& animal : zoo::animals()) {
    const Surface surface(animal.mesh);
    Random random(5);
    for (int k = 0; k < 200; ++k) {
      const Vec3 place = somewhere_around(surface, random);
      const SurfacePoint found = surface.project(place);
      expect_weights(found);
      // Ties are broken within 1e-12 of the diameter.
      EXPECT_NEAR((surface.position(found) - place).norm(), distance_by_brute_force(surface, place),
                  2e-12 * surface.diameter())
          << animal.name;
    }
  }
}

TEST(Project, LeavesPointsOfTheSurfaceInPlace) {
  for (const zoo::Animal& animal : zoo::animals()) {
    const Surface surface(animal.mesh);
    Random random(6);
    for (const SurfacePoint& point : sample_uniformly(surface, 100, random)) {
      const Vec3 place = surface.position(point);
      EXPECT_LT((surface.position(surface.project(place)) - place).norm(),
                2e-12 * surface.diameter())
          << animal.name;
    }
  }
}

TEST(Project, GivesTiesToTheLowestFace) {
  for (const zoo::Animal& animal : zoo::animals()) {
    const Surface surface(animal.mesh);
    for (int v = 0; v < surface.vertex_count(); ++v) {
      EXPECT_EQ(surface.project(surface.vertex(v)).face, surface.face_of_vertex(v))
          << animal.name << " at vertex " << v;
    }
    for (int f = 0; f < surface.face_count(); ++f) {
      for (int i = 0; i < 3; ++i) {
        const Vec3 middle = 0.5 * (surface.vertex(surface.triangle(f)[i]) +
                                   surface.vertex(surface.triangle(f)[(i + 1) % 3]));
        const int across = surface.neighbour(f, i);
        EXPECT_EQ(surface.project(middle).face, across < 0 ? f : std::min(f, across))
            << animal.name;
      }
    }
  }
}

TEST(Project, ChoosesTheLowestFaceFromTheCentreOfASphere) {
  // Every face of the icosahedron is equally far.
  EXPECT_EQ(Surface(zoo::icosahedron_mesh()).project(Vec3::Zero()).face, 0);
}

TEST(Project, MovesWithTheSurface) {
  const Surface torus(zoo::torus_mesh(2.0, 0.7, 24, 16));
  const Eigen::Matrix3d rotation = zoo::some_rotation();
  const Vec3 shift(0.1, 0.2, -0.3);
  const Surface moved(zoo::moved(torus.mesh(), rotation, shift, 0.01));
  Random random(8);
  for (int k = 0; k < 200; ++k) {
    const Vec3 place = somewhere_around(torus, random);
    const Vec3 expected = 0.01 * (rotation * torus.position(torus.project(place))) + shift;
    const Vec3 found = moved.position(moved.project(0.01 * (rotation * place) + shift));
    // Distances agree to 1e-12; the closest point itself only to the root of that, where the
    // surface bends towards the place.
    EXPECT_LT((found - expected).norm(), 1e-6 * moved.diameter());
  }
}

TEST(Project, FindsTheSamePlaceUnderOtherNumbers) {
  const TriangleMesh mesh = zoo::jittered_square_mesh(12, 3);
  Random random(9);
  const Surface square(mesh),
      other(zoo::reordered(zoo::relabelled(mesh, zoo::shuffled(169, random)), random));
  for (int k = 0; k < 200; ++k) {
    const Vec3 place = somewhere_around(square, random);
    EXPECT_LT(
        (square.position(square.project(place)) - other.position(other.project(place))).norm(),
        3e-12);
  }
}

TEST(Project, WorksFarAwayAndOnOneTriangle) {
  TriangleMesh mesh{Points(3, 3), Triangles(1, 3)};
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  mesh.triangles << 0, 1, 2;
  const Surface triangle(mesh);
  EXPECT_EQ(triangle.position(triangle.project(Vec3(1e9, 0.0, 3.0))), Vec3(1.0, 0.0, 0.0));
  EXPECT_LT(
      (triangle.position(triangle.project(Vec3(0.25, 0.25, 1e6))) - Vec3(0.25, 0.25, 0.0)).norm(),
      1e-9);
}

TEST(Project, KeepsItsDigitsOnSlivers) {
  TriangleMesh mesh{Points(3, 3), Triangles(1, 3)};
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0.5, 1e-10, 0;
  mesh.triangles << 0, 1, 2;
  const Surface sliver(mesh);
  const Vec3 found = sliver.position(sliver.project(Vec3(0.3, 0.4, 0.5)));
  EXPECT_NEAR(found.x(), 0.3, 1e-9);  // the edge rises by 2e-10
  expect_weights(sliver.project(Vec3(0.3, 1e-11, 0.5)));
}

TEST(Project, RefusesPlacesThatAreNone) {
  EXPECT_THROW(
      zoo::unit_square(2).project(Vec3(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0)),
      InvalidInput);
}

TEST(Project, BuildsTheTreeOnlyWhenAsked) {
  const Surface square = zoo::unit_square(2);
  EXPECT_TRUE(square.computed().empty());
  square.project(Vec3::Zero());
  EXPECT_EQ(square.computed(), std::vector<std::string>{"search tree"});
}

}  // namespace
}  // namespace palpation
