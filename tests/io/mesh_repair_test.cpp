// Repairs that are done only on request, each told with how many elements it took and where the
// first of them lies.
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "palpation/base/error.h"
#include "palpation/geometry/surface.h"
#include "palpation/io/read_mesh.h"

namespace palpation {
namespace {

// The unit square in lines 1 to 6 of an OBJ, cut along its diagonal from vertex 1 to vertex 3.
const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";

MeshFile read_obj(const std::string& content, const MeshRepair& repair) {
  const TemporaryFolder folder;
  return read_mesh_of_any_size(folder.file("a.obj", content), LengthUnit::Metre, repair);
}

void expect_told(const MeshFile& file, const std::vector<std::string>& parts) {
  ASSERT_EQ(file.warnings.size(), parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i)
    EXPECT_TRUE(contains(file.warnings[i].text, parts[i])) << file.warnings[i].text;
}

void expect_error(const std::string& content, const MeshRepair& repair, const std::string& part) {
  try {
    read_obj(content, repair);
    ADD_FAILURE() << "not refused: " << part;
  } catch (const IoError& error) {
    EXPECT_TRUE(contains(error.what(), part)) << error.what();
  }
}

TEST(MeshRepair, DropsDuplicatesAndKeepsTheFirst) {
  const std::string twice = kSquare + "f 2 3 1\nf 4 3 1\n";  // one of them the other way round
  expect_error(twice, {}, "has the corners of face 1 again");
  const MeshFile file = read_obj(twice, {.drop_duplicates = true});
  expect_told(file, {"2 triangles with the corners of an earlier one were dropped, the first: face "
                     "3 in line 7, whose first corner is at (1, 0, 0)"});
  EXPECT_EQ(file.mesh.triangles.rows(), 2);
  EXPECT_DOUBLE_EQ(Surface(file.mesh).area(), 1.0);
}

// Vertex 5 lies in the middle of the diagonal, in a triangle with it: dropped, the other triangle
// of the diagonal is cut there, and the surface has neither crack nor hole.
TEST(MeshRepair, DropsACapWithoutACrack) {
  const std::string cap =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 0\n"
      "f 1 2 5\nf 5 2 3\nf 1 5 3\nf 1 3 4\n";
  EXPECT_THROW(Surface(read_obj(cap, {}).mesh), InvalidMesh);
  const MeshFile file = read_obj(cap, {.drop_flat = true});
  expect_told(file, {"1 triangle without an area was dropped: face 3 in line 8"});
  EXPECT_TRUE(contains(file.warnings[0].advice, "no crack"));
  const Surface surface(file.mesh);
  EXPECT_EQ(surface.face_count(), 4);
  EXPECT_EQ(surface.topology().borders, 1);
  EXPECT_DOUBLE_EQ(surface.area(), 1.0);
}

TEST(MeshRepair, DropsCapsInARowAlongOneLine) {
  // Ten vertices along the diagonal, one half sewn to them, the other to its ends by a fan of caps.
  std::string row = "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 1; i <= 10; ++i)
    row += "v " + std::to_string(i / 16.0) + " " + std::to_string(i / 16.0) + " 0\n";
  row += "f 1 2 4\n";  // beyond the caps
  std::string previous = "1";
  for (int i = 5; i <= 14; ++i) {
    row += "f " + previous + " 3 " + std::to_string(i) + "\n";
    if (i > 5) row += "f 1 " + previous + " " + std::to_string(i) + "\n";
    previous = std::to_string(i);
  }
  row += "f 14 3 2\nf 1 14 2\n";
  const MeshFile file = read_obj(row, {.drop_flat = true});
  expect_told(file, {"10 triangles without an area were dropped, the first: face 4 in line 18"});
  const Surface surface(file.mesh);
  EXPECT_EQ(surface.topology().borders, 1);
  EXPECT_EQ(surface.vertex_count(), 14);
  EXPECT_DOUBLE_EQ(surface.area(), 1.0);
}

// Vertices 3 and 5 are in one place. Without the triangle between them the two halves touch in
// vertex 1 alone; welded, they share an edge.
TEST(MeshRepair, DropsANeedleAndWeldsItsSeam) {
  const std::string needle =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 1 0\n"
      "f 1 2 3\nf 1 3 5\nf 1 5 4\n";
  const MeshFile seam = read_obj(needle, {.drop_flat = true});
  EXPECT_TRUE(contains(seam.warnings[0].advice, "1 of them leaves a seam"));
  EXPECT_THROW(Surface(seam.mesh), InvalidMesh);
  const MeshFile welded = read_obj(needle, {.weld_equal_vertices = true, .drop_flat = true});
  expect_told(welded, {"1 vertices were joined",
                       "1 face with fewer than three different corners was dropped: face 2"});
  EXPECT_EQ(Surface(welded.mesh).topology().components, 1);
}

TEST(MeshRepair, CountsACornerThatFollowsItselfOnce) {
  const std::string quads = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 3\nf 1 3 4 1\nf 2 3 2\n";
  expect_error(quads, {}, "face 1: uses vertex 3 twice");
  const MeshFile file = read_obj(quads, {.drop_flat = true});
  EXPECT_EQ(file.mesh.triangles.rows(), 2);
  expect_told(file, {"1 face with fewer than three different corners was dropped: face 3 in line "
                     "7, whose first corner is at (1, 0, 0)"});
  expect_error(kSquare + "f 1 2 1 3\n", {.drop_flat = true}, "uses vertex 1 twice");
}

TEST(MeshRepair, CutsPolygonsThatNoCornerSeesAsAWhole) {
  const std::string comb =
      "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 2 3 0\nv 2 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\n"
      "f 1 2 3 4 5 6 7 8\n";
  expect_error(comb, {}, "no fan of triangles covers once");
  const MeshFile file = read_obj(comb, {.cut_polygons = true});
  expect_told(file, {"1 face with more than three corners was cut into triangles: face 1 in line "
                     "9, whose first corner is at (0, 0, 0)"});
  EXPECT_DOUBLE_EQ(Surface(file.mesh).area(), 7.0);
  expect_error("v 0 0 0\nv 3 1 0\nv 3 0 0\nv 0 2 0\nf 1 2 3 4\n", {.cut_polygons = true},
               "no fan of triangles covers once");
}

// The smaller component has more triangles, and touches the larger one in a vertex.
TEST(MeshRepair, KeepsTheComponentOfTheLargestArea) {
  const std::string two =
      "v -0.1 0 0\nv -0.1 -0.1 0\nv 0 -0.1 0\nv -0.2 -0.1 0\n"
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
      "f 5 1 2\nf 5 2 3\nf 1 4 2\nf 5 6 7\nf 5 7 8\n";
  const MeshFile file = read_obj(two, {.keep_largest = true});
  expect_told(file, {"3 triangles of 1 smaller component, 1.48 % of the area, were dropped, the "
                     "first: face 1 in line 9, whose first corner is at (0, 0, 0)",
                     "4 vertices belong to no face"});
  const Surface surface(file.mesh);
  EXPECT_DOUBLE_EQ(surface.area(), 1.0);
  EXPECT_EQ(surface.vertex_count(), 4);
}

TEST(MeshRepair, DoesNothingThatIsNotNeeded) {
  const MeshFile plain = read_obj(kSquare, {});
  const MeshFile file = read_obj(kSquare, {.weld_equal_vertices = true,
                                           .cut_polygons = true,
                                           .drop_duplicates = true,
                                           .drop_flat = true,
                                           .keep_largest = true});
  EXPECT_TRUE(file.warnings.empty());
  EXPECT_EQ(file.mesh.triangles, plain.mesh.triangles);
  EXPECT_EQ(file.mesh.vertices, plain.mesh.vertices);
}

TEST(MeshRepair, SaysWhenNothingIsLeft) {
  expect_error("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", {.drop_flat = true},
               "no face has an area: nothing is left of the OBJ");
}

}  // namespace
}  // namespace palpation
