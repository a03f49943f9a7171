#include "geometry/self_intersection.h"

#include <gtest/gtest.h>

#include "geometry/zoo.h"

namespace palpation {
namespace {

Surface surface_of(const std::vector<Vec3>& points, const std::vector<Eigen::Vector3i>& faces) {
  TriangleMesh mesh{Points(static_cast<Eigen::Index>(points.size()), 3),
                    Triangles(static_cast<Eigen::Index>(faces.size()), 3)};
  for (std::size_t i = 0; i < points.size(); ++i)
    mesh.vertices.row(static_cast<Eigen::Index>(i)) = points[i];
  for (std::size_t i = 0; i < faces.size(); ++i)
    mesh.triangles.row(static_cast<Eigen::Index>(i)) = faces[i];
  return Surface(mesh);
}

Surface two_of(const TriangleMesh& mesh, const Vec3& apart) {
  TriangleMesh both{Points(2 * mesh.vertices.rows(), 3), Triangles(2 * mesh.triangles.rows(), 3)};
  both.vertices << mesh.vertices, mesh.vertices.rowwise() + apart.transpose();
  both.triangles << mesh.triangles, mesh.triangles.array() + static_cast<int>(mesh.vertices.rows());
  return Surface(both);
}

TEST(SelfIntersections, AreNoneInSoundSurfaces) {
  for (const TriangleMesh& mesh : {zoo::unit_square_mesh(5), zoo::jittered_square_mesh(9, 1),
                                   zoo::tetrahedron_mesh(), zoo::icosphere_mesh(3)}) {
    const SelfIntersections found = self_intersections(Surface(mesh));
    EXPECT_EQ(found.pairs, 0);
    EXPECT_FALSE(found.first);
    EXPECT_TRUE(found.complete);
  }
}

TEST(SelfIntersections, AreFoundWhereTwoSheetsCross) {
  // Faces 0 and 1 apart from each other; 1 stands upright through 0.
  const Surface crossing =
      surface_of({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -1}, {0.5, 0.5, 1}, {3, 3, 0}},
                 {{0, 1, 2}, {3, 4, 5}});
  const SelfIntersections found = self_intersections(crossing);
  EXPECT_EQ(found.pairs, 1);
  EXPECT_EQ(found.first, (std::array<int, 2>{0, 1}));
}

TEST(SelfIntersections, AreFoundWhereATriangleIsFoldedOntoItsNeighbour) {
  EXPECT_EQ(self_intersections(surface_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.3, 0}},
                                          {{0, 1, 2}, {1, 0, 3}}))
                .pairs,
            1);
  EXPECT_EQ(self_intersections(surface_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.3, 1e-9}},
                                          {{0, 1, 2}, {1, 0, 3}}))
                .pairs,
            0);
}

TEST(SelfIntersections, AreFoundWhereTwoTrianglesOfAVertexCross) {
  // A fan round vertex 0 whose last triangle dives through the first.
  const Surface fan =
      surface_of({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {-1, 1, 1}, {1, 1, 1}, {1, 1, -2}},
                 {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}});
  EXPECT_EQ(self_intersections(fan).first, (std::array<int, 2>{0, 3}));
}

TEST(SelfIntersections, AreNotTheSeamsOfAMesh) {
  // The square with its diagonal's corners there twice.
  EXPECT_EQ(self_intersections(
                surface_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                           {{0, 1, 2}, {3, 4, 5}}))
                .pairs,
            0);
}

TEST(SelfIntersections, DoNotDependOnTheScale) {
  for (const double scale : {1e-40, 1.0, 1e40}) {
    TriangleMesh mesh = zoo::icosphere_mesh(2);
    mesh.vertices *= scale;
    EXPECT_GT(self_intersections(two_of(mesh, Vec3(0.7, 0.1, 0.2) * scale)).pairs, 10) << scale;
    EXPECT_EQ(self_intersections(two_of(mesh, Vec3(2.1, 0.0, 0.0) * scale)).pairs, 0) << scale;
  }
}

// A thousand needles through one place: every box meets every other.
TEST(SelfIntersections, AreGivenUpWhereAllTrianglesAreCloseTogether) {
  std::vector<Vec3> points;
  std::vector<Eigen::Vector3i> faces;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 1e-3 * i;
    points.insert(points.end(),
                  {Vec3(std::cos(angle), std::sin(angle), 1.0),
                   Vec3(-std::cos(angle), -std::sin(angle), -1.0), Vec3(0.01, 0.01, 1e-3 * i)});
    faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  EXPECT_FALSE(self_intersections(surface_of(points, faces)).complete);
}

}  // namespace
}  // namespace palpation
