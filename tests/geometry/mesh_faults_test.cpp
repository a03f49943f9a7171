#include "geometry/mesh_faults.h"

#include <gtest/gtest.h>

#include "geometry/zoo.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

TriangleMesh mesh_of(std::vector<Vec3> points, const std::vector<Eigen::Vector3i>& faces) {
  TriangleMesh mesh{Points(static_cast<Eigen::Index>(points.size()), 3),
                    Triangles(static_cast<Eigen::Index>(faces.size()), 3)};
  for (std::size_t i = 0; i < points.size(); ++i)
    mesh.vertices.row(static_cast<Eigen::Index>(i)) = points[i];
  for (std::size_t i = 0; i < faces.size(); ++i)
    mesh.triangles.row(static_cast<Eigen::Index>(i)) = faces[i];
  return mesh;
}

// The square 0 1 2 3, and points above it and beside it.
const std::vector<Vec3> kPoints = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0},   {0, 1, 0},
                                   {0, 0, 1}, {2, 0, 0}, {-1, -1, 0}, {-1, 0, 0}};

TEST(CountFaults, FindsNoneInASurface) {
  EXPECT_FALSE(count_faults(zoo::unit_square_mesh(4)).any());
  EXPECT_FALSE(count_faults(zoo::tetrahedron_mesh()).any());
  EXPECT_FALSE(count_faults(zoo::icosphere_mesh(2)).any());
}

TEST(CountFaults, CountsAnEdgeOfThreeTriangles) {
  const MeshFaults faults = count_faults(mesh_of(kPoints, {{0, 1, 2}, {0, 2, 3}, {0, 2, 4}}));
  EXPECT_EQ(faults.crowded_edges, 1);
  EXPECT_EQ(faults.pinched_vertices, 0);
}

TEST(CountFaults, CountsAnEdgeRunThroughTwiceInOneDirection) {
  EXPECT_EQ(count_faults(mesh_of(kPoints, {{0, 1, 2}, {0, 3, 2}})).one_way_edges, 1);
}

TEST(CountFaults, CountsAVertexOfTwoFans) {
  const MeshFaults faults = count_faults(mesh_of(kPoints, {{0, 1, 2}, {0, 2, 3}, {0, 7, 6}}));
  EXPECT_EQ(faults.pinched_vertices, 1);
  EXPECT_EQ(faults.crowded_edges + faults.one_way_edges + faults.flat_triangles, 0);
}

TEST(CountFaults, CountsTrianglesWithoutArea) {
  EXPECT_EQ(count_faults(mesh_of(kPoints, {{0, 1, 2}, {1, 0, 5}})).flat_triangles, 1);
}

TEST(CountFaults, RefusesTrianglesOfVerticesThatDoNotExist) {
  EXPECT_THROW(count_faults(mesh_of(kPoints, {{0, 1, 8}})), InvalidInput);
  EXPECT_THROW(count_faults(mesh_of(kPoints, {{0, 1, 1}})), InvalidInput);
}

}  // namespace
}  // namespace palpation
