#include "geometry/coarsen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/zoo.h"
#include "palpation/base/error.h"
#include "palpation/geometry/make_phantom.h"

namespace palpation {
namespace {

/// Lengths of all edges, each inner one twice.
std::vector<double> edges_of(const Surface& surface) {
  std::vector<double> lengths;
  for (int face = 0; face < surface.face_count(); ++face) {
    const Eigen::Vector3i corners = surface.triangle(face);
    for (int i = 0; i < 3; ++i)
      lengths.push_back((surface.vertex(corners[(i + 1) % 3]) - surface.vertex(corners[i])).norm());
  }
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

TEST(Coarsen, LeavesVerticesOfTheSurfaceAboutAsFarApartAsAsked) {
  const Surface fine = zoo::jittered_square(60, 3);
  const CoarseMesh coarse = coarsen(fine, 0.1);
  const Surface surface(coarse.mesh);
  EXPECT_TRUE(std::is_sorted(coarse.vertices.begin(), coarse.vertices.end()));
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex)
    EXPECT_EQ(surface.vertex(vertex), fine.vertex(coarse.vertices[vertex]));
  EXPECT_GT(surface.vertex_count(), 70);
  EXPECT_LT(surface.vertex_count(), 250);
  const std::vector<double> edges = edges_of(surface);
  EXPECT_LE(edges.back(), 0.15 + 1e-12);
  EXPECT_GT(edges[edges.size() / 2], 0.08);
}

TEST(Coarsen, KeepsTheOutlineOfAFlatPieceExactly) {
  const Surface fine = zoo::jittered_square(40, 5);
  const Surface coarse(coarsen(fine, 0.12).mesh);
  EXPECT_NEAR(coarse.area(), 1.0, 1e-12);
  EXPECT_TRUE(coarse.is_planar());
  EXPECT_TRUE(coarse.topology().is_disk());
}

TEST(Coarsen, KeepsComponentsBordersAndHandles) {
  for (const TriangleMesh& mesh : {zoo::torus_mesh(2.0, 0.7, 60, 40), zoo::icosphere_mesh(4)}) {
    const Surface fine(mesh), coarse(coarsen(fine, 0.25).mesh);
    EXPECT_LT(coarse.vertex_count(), fine.vertex_count());
    EXPECT_EQ(coarse.topology().euler, fine.topology().euler);
    EXPECT_EQ(coarse.topology().borders, fine.topology().borders);
    EXPECT_EQ(coarse.topology().components, fine.topology().components);
  }
}

TEST(Coarsen, StaysNearCurvedTissue) {
  Random random(2);
  const Surface fine(make_phantom(wave_sheet(), 0.0004, 0.3, random).mesh);
  const Surface coarse(coarsen(fine, 0.0015).mesh);
  EXPECT_LT(coarse.vertex_count(), fine.vertex_count() / 5);
  EXPECT_NEAR(coarse.area() / fine.area(), 1.0, 0.01);
  double farthest = 0.0;
  for (int vertex = 0; vertex < fine.vertex_count(); ++vertex) {
    farthest = std::max(
        farthest,
        (coarse.position(coarse.project(fine.vertex(vertex))) - fine.vertex(vertex)).norm());
  }
  EXPECT_LT(farthest, 0.0002) << "of edges of 1.5 to 2.25 mm";
}

TEST(Coarsen, LeavesAMeshThatIsCoarseEnough) {
  const Surface fine = zoo::unit_square(10);
  const CoarseMesh same = coarsen(fine, 0.05);
  EXPECT_EQ(same.mesh.vertices, fine.mesh().vertices);
  EXPECT_EQ(same.mesh.triangles.rows(), fine.face_count());
}

TEST(Coarsen, RefusesLengthsThatAreNone) {
  const Surface fine = zoo::unit_square(4);
  for (const double edge_m : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(coarsen(fine, edge_m), InvalidInput);
}

}  // namespace
}  // namespace palpation
