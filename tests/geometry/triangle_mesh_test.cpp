#include "palpation/geometry/triangle_mesh.h"

#include <gtest/gtest.h>

#include <limits>

#include "geometry/zoo.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

double longest_edge(const TriangleMesh& mesh) {
  double longest = 0.0;
  for (const auto& t : mesh.triangles.rowwise()) {
    for (int i = 0; i < 3; ++i)
      longest =
          std::max(longest, (mesh.vertices.row(t[i]) - mesh.vertices.row(t[(i + 1) % 3])).norm());
  }
  return longest;
}

TEST(Extent, IsTheLongestSideOfTheBox) {
  TriangleMesh mesh = zoo::tetrahedron_mesh();
  mesh.vertices.row(3) << 0.0, 0.0, -4.0;
  EXPECT_EQ(extent_m(mesh), 4.0);
  EXPECT_EQ(extent_m({}), 0.0);
}

TEST(Refine, KeepsAreaAndTopologyOfEveryAnimal) {
  for (const zoo::Animal& animal : zoo::animals()) {
    const Surface coarse(animal.mesh);
    const Surface fine(refine(animal.mesh, 0.4 * longest_edge(animal.mesh)));
    EXPECT_EQ(fine.face_count(), 16 * coarse.face_count())
        << animal.name;  // 0.4 takes two halvings
    EXPECT_NEAR(fine.area(), coarse.area(), 1e-13 * coarse.area())
        << animal.name << ": rounding of sums of some thousand terms";
    EXPECT_EQ(fine.topology().components, coarse.topology().components) << animal.name;
    EXPECT_EQ(fine.topology().borders, coarse.topology().borders) << animal.name;
    EXPECT_EQ(fine.topology().euler, coarse.topology().euler) << animal.name;
  }
}

TEST(Refine, LeavesNoEdgeLongerThanAsked) {
  const TriangleMesh fine = refine(zoo::jittered_square_mesh(5, 7), 0.03);
  EXPECT_LE(longest_edge(fine), 0.03);
  EXPECT_GT(longest_edge(fine), 0.015);  // one pass less would have been too few
}

TEST(Refine, SharesTheMidpointOfAnEdgeBetweenItsTriangles) {
  // A unit square of 2 triangles has 5 edges: 4 + 5 vertices.
  const TriangleMesh fine = refine(zoo::unit_square_mesh(1), 1.0);
  ASSERT_EQ(fine.vertices.rows(), 9);
  ASSERT_EQ(fine.triangles.rows(), 8);
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < i; ++j) EXPECT_NE(fine.vertices.row(i), fine.vertices.row(j));
  }
}

TEST(Refine, LeavesAMeshAloneThatIsFineEnough) {
  const TriangleMesh mesh = zoo::tetrahedron_mesh();
  const TriangleMesh same = refine(mesh, std::sqrt(2.0));
  EXPECT_EQ(same.vertices, mesh.vertices);
  EXPECT_EQ(same.triangles, mesh.triangles);
  EXPECT_EQ(refine({}, 1.0).triangles.rows(), 0);
}

TEST(Refine, KeepsTheOldVerticesFirst) {
  const TriangleMesh mesh = zoo::icosahedron_mesh();
  EXPECT_EQ(refine(mesh, 0.3).vertices.topRows(12), mesh.vertices);
}

TEST(Refine, RefusesLengthsThatAreNone) {
  for (const double length : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(refine(zoo::tetrahedron_mesh(), length), InvalidInput) << length;
  }
}

TEST(Refine, RefusesMoreTrianglesThanFitBeforeMakingThem) {
  EXPECT_THROW(refine(zoo::tetrahedron_mesh(), 1e-6), InvalidInput);
  EXPECT_THROW(refine(zoo::tetrahedron_mesh(), std::numeric_limits<double>::denorm_min()),
               InvalidInput);
}

TEST(Refine, RefusesIndicesAndCoordinatesThatAreNone) {
  TriangleMesh mesh = zoo::tetrahedron_mesh();
  mesh.triangles(2, 1) = 4;
  EXPECT_THROW(refine(mesh, 0.5), InvalidInput);
  mesh = zoo::tetrahedron_mesh();
  mesh.vertices(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(refine(mesh, 0.5), InvalidInput);
}

}  // namespace
}  // namespace palpation
