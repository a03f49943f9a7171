// Every way to break the contract of surface.h, and what is said about it.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "geometry/zoo.h"
#include "palpation/base/error.h"
#include "palpation/geometry/surface.h"

namespace palpation {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What a Surface says against the mesh, or "accepted".
std::string complaint(const TriangleMesh& mesh) {
  try {
    const Surface surface(mesh);
    return "accepted";
  } catch (const InvalidMesh& refusal) {
    return refusal.what();
  }
}

TriangleMesh mesh_of(std::initializer_list<Vec3> vertices,
                     std::initializer_list<Eigen::Vector3i> triangles) {
  TriangleMesh mesh{Points(static_cast<Eigen::Index>(vertices.size()), 3),
                    Triangles(static_cast<Eigen::Index>(triangles.size()), 3)};
  Eigen::Index row = 0;
  for (const Vec3& vertex : vertices) mesh.vertices.row(row++) = vertex;
  row = 0;
  for (const Eigen::Vector3i& triangle : triangles) mesh.triangles.row(row++) = triangle;
  return mesh;
}

const Vec3 kO(0.0, 0.0, 0.0), kX(1.0, 0.0, 0.0), kY(0.0, 1.0, 0.0), kZ(0.0, 0.0, 1.0);

TEST(SurfaceContract, OneTriangleIsASurface) {
  EXPECT_EQ(complaint(mesh_of({kO, kX, kY}, {{0, 1, 2}})), "accepted");
}

TEST(SurfaceContract, AnEmptyMeshIsNone) {
  EXPECT_EQ(complaint({}), "Surface: a mesh of 0 vertices must have at least one triangle");
  EXPECT_EQ(complaint(mesh_of({kO, kX}, {})),
            "Surface: a mesh of 2 vertices must have at least one triangle");
}

TEST(SurfaceContract, CoordinatesAreFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(complaint(mesh_of({kO, kX, Vec3(0.0, nan, 1.0)}, {{0, 1, 2}})),
            "Surface: vertex 2 at (0, nan, 1) must have finite coordinates");
  EXPECT_EQ(complaint(mesh_of({kO, Vec3(-kInfinity, 0.0, 0.0), kY}, {{0, 1, 2}})),
            "Surface: vertex 1 at (-inf, 0, 0) must have finite coordinates");
}

TEST(SurfaceContract, IndicesAreInRange) {
  EXPECT_EQ(complaint(mesh_of({kO, kX, kY}, {{0, 1, 2}, {1, 2, 3}})),
            "Surface: triangle 1 of vertices 1, 2, 3 must only use vertices that exist, 0 to 2");
  EXPECT_EQ(complaint(mesh_of({kO, kX, kY}, {{0, -1, 2}})),
            "Surface: triangle 0 of vertices 0, -1, 2 must only use vertices that exist, 0 to 2");
}

TEST(SurfaceContract, ATriangleHasThreeVertices) {
  EXPECT_EQ(complaint(mesh_of({kO, kX, kY * 3.0}, {{0, 1, 2}, {1, 2, 2}})),
            "Surface: triangle 1 of vertices 1, 2, 2 at (0.3333333333333333, 2, 0) must have three "
            "different vertices");
}

TEST(SurfaceContract, AnEdgeHasALength) {
  EXPECT_EQ(
      complaint(mesh_of({kO, kX, kX}, {{0, 1, 2}})),
      "Surface: triangle 0 of vertices 0, 1, 2 at (0.6666666666666666, 0, 0) must have no edge of "
      "zero length: two of its vertices are in one place");
}

TEST(SurfaceContract, ATriangleHasAnArea) {
  EXPECT_EQ(complaint(mesh_of({kO, kX * 3.0, kX * 6.0}, {{0, 1, 2}})),
            "Surface: triangle 0 of vertices 0, 1, 2 at (3, 0, 0) must have an area: its vertices "
            "are on one line");
  // 0.1, 0.2 and 0.3 are not equally spaced in binary: the cross product is not zero, but rounding
  // all the same.
  const std::string almost = complaint(
      mesh_of({Vec3(0.1, 0.1, 0.7), Vec3(0.2, 0.2, 1.4), Vec3(0.3, 0.3, 2.1)}, {{0, 1, 2}}));
  EXPECT_NE(almost.find("must have an area"), std::string::npos) << almost;
}

TEST(SurfaceContract, SliversAreTriangles) {
  EXPECT_EQ(complaint(mesh_of({kO, kX, Vec3(0.5, 1e-12, 0.0)}, {{0, 1, 2}})), "accepted");
}

TEST(SurfaceContract, EveryVertexIsUsed) {
  EXPECT_EQ(complaint(mesh_of({kO, kX, kZ * 5.0, kY}, {{0, 1, 3}})),
            "Surface: vertex 2 at (0, 0, 5) must be used by a triangle");
}

TEST(SurfaceContract, AnEdgeHasAtMostTwoTriangles) {
  EXPECT_EQ(complaint(mesh_of({kO, kX * 2.0, kY, kZ, -kY}, {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}})),
            "Surface: edge between vertices 0 and 1 at (1, 0, 0) must be in one or two triangles, "
            "and is in 3: 0, 1, 2");
}

TEST(SurfaceContract, NeighboursRunThroughTheirEdgeInOppositeDirections) {
  EXPECT_EQ(complaint(mesh_of({kO, kX * 2.0, kY, -kY}, {{0, 1, 2}, {0, 1, 3}})),
            "Surface: edge between vertices 0 and 1 at (1, 0, 0) must be run through in opposite "
            "directions by its two triangles, 0, 1: "
            "one of them is "
            "turned round, or the surface has one side only");
  const std::string doubled = complaint(mesh_of({kO, kX, kY}, {{0, 1, 2}, {0, 1, 2}}));
  EXPECT_NE(doubled.find("opposite directions"), std::string::npos) << doubled;
}

TEST(SurfaceContract, AMoebiusStripIsNone) {
  // Five vertices, five triangles, each sharing an edge with the next.
  TriangleMesh strip = mesh_of({Vec3(1, 0, 0), Vec3(0.3, 0.9, 0.4), Vec3(-0.8, 0.6, 0),
                                Vec3(-0.8, -0.6, 0.4), Vec3(0.3, -0.9, 0)},
                               {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 0, 4}, {4, 0, 1}});
  EXPECT_NE(complaint(strip).find("one side only"), std::string::npos) << complaint(strip);
}

TEST(SurfaceContract, TheTrianglesAroundAVertexAreOneFan) {
  EXPECT_EQ(complaint(mesh_of({kO, kX, kY, -kX, -kY}, {{0, 1, 2}, {0, 3, 4}})),
            "Surface: vertex 0 at (0, 0, 0) must have its triangles in one fan: of 2, only 1 hang "
            "together with triangle 0");
  // Two tetrahedra tip to tip: closed fans.
  TriangleMesh tips =
      zoo::together(zoo::tetrahedron_mesh(),
                    zoo::moved(zoo::tetrahedron_mesh(), zoo::some_rotation(), Vec3(0.0, 0.0, 1.0)));
  tips.triangles = (tips.triangles.array() == 4)
                       .select(3, tips.triangles);  // the second's first vertex is the first's top
  for (int& index : tips.triangles.reshaped()) index -= index > 4 ? 1 : 0;
  Points seven(7, 3);
  seven << tips.vertices.topRows(4), tips.vertices.bottomRows(3);
  tips.vertices = seven;
  EXPECT_NE(complaint(tips).find(
                "vertex 3 at (0, 0, 1) must have its triangles in one fan: of 6, only 3"),
            std::string::npos)
      << complaint(tips);
}

TEST(SurfaceContract, ADoubledTriangleBackToBackIsAClosedSurface) {
  const Surface pillow(mesh_of({kO, kX, kY}, {{0, 1, 2}, {0, 2, 1}}));
  EXPECT_TRUE(pillow.topology().is_closed());
  EXPECT_FALSE(pillow.is_planar());
  EXPECT_EQ(pillow.vertex_normals().row(0), kZ.transpose())
      << "where the sides cancel, the lowest face decides";
}

TEST(SurfaceContract, SizesWhoseAreasAreNoNumbersAreRefused) {
  for (const double scale : {1e-100, 1e100}) {
    const std::string text = complaint(
        zoo::moved(zoo::tetrahedron_mesh(), Eigen::Matrix3d::Identity(), Vec3::Zero(), scale));
    EXPECT_NE(text.find("between 1e-60 and 1e60 m across"), std::string::npos) << text;
  }
}

TEST(SurfaceContract, TheFirstElementAtFaultIsNamed) {
  TriangleMesh mesh = zoo::unit_square_mesh(3);
  mesh.triangles.row(7).setConstant(2);
  mesh.triangles.row(11).setConstant(1);
  EXPECT_NE(complaint(mesh).find("triangle 7 "), std::string::npos);
}

}  // namespace
}  // namespace palpation
