#include "palpation/io/read_mesh.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "io/mesh_seeds.h"
#include "io/temporary_folder.h"
#include "palpation/base/random.h"

namespace palpation {
namespace {

MeshFile read_text(const std::string& name, const std::string& content,
                   const MeshRepair& repair = {}) {
  const TemporaryFolder folder;
  return read_mesh_of_any_size(folder.file(name, content), LengthUnit::Metre, repair);
}

std::vector<std::vector<int>> faces_of(const MeshFile& file) {
  std::vector<std::vector<int>> faces;
  for (Eigen::Index i = 0; i < file.mesh.triangles.rows(); ++i) {
    faces.push_back(
        {file.mesh.triangles(i, 0), file.mesh.triangles(i, 1), file.mesh.triangles(i, 2)});
  }
  return faces;
}

bool warns(const MeshFile& file, const std::string& part) {
  for (const MeshWarning& warning : file.warnings) {
    if (contains(warning.text, part)) return true;
  }
  return false;
}

using Faces = std::vector<std::vector<int>>;

bool holds_floats(const std::string& format, const std::string& name) {
  return format == "binary STL" || contains(name, "VTP in compressed base64") ||
         contains(name, "VTP appended");
}

// Exact in every format: text gives the doubles that it was written from, and floats stay the
// floats they are.
TEST(ReadMesh, ReadsTheSameShapesFromEveryFormat) {
  const std::map<std::string, catalogue::Shape> shapes = {{"square", catalogue::square()},
                                                          {"tetrahedron", catalogue::tetrahedron()},
                                                          {"grid", catalogue::grid()}};
  for (const catalogue::MeshSeed& seed : catalogue::mesh_seeds()) {
    const MeshFile file = read_text(seed.file, seed.bytes);
    const catalogue::Shape& shape = shapes.at(seed.file.substr(0, seed.file.find('.')));
    EXPECT_TRUE(file.warnings.empty()) << seed.name << ": " << file.warnings.front().text;
    ASSERT_EQ(file.mesh.vertices.rows(), seed.vertices) << seed.name;
    ASSERT_EQ(file.mesh.triangles.rows(), seed.faces) << seed.name;
    for (std::size_t face = 0; face < shape.faces.size(); ++face) {
      for (int corner = 0; corner < 3; ++corner) {
        // STL numbers its vertices in the order of their corners, so places are compared.
        const Vec3 place =
            file.mesh.vertices.row(file.mesh.triangles(static_cast<Eigen::Index>(face), corner));
        const std::array<double, 3>& expected = shape.points[static_cast<std::size_t>(
            shape.faces[face][static_cast<std::size_t>(corner)])];
        for (int i = 0; i < 3; ++i) {
          const double exact = expected[static_cast<std::size_t>(i)];
          EXPECT_TRUE(place[i] == exact || (holds_floats(file.format, seed.name) &&
                                            place[i] == double{static_cast<float>(exact)}))
              << seed.name;
        }
      }
    }
  }
}

TEST(ReadMesh, NamesTheFormat) {
  std::set<std::string> formats;
  for (const catalogue::MeshSeed& seed : catalogue::mesh_seeds())
    formats.insert(read_text(seed.file, seed.bytes).format);
  EXPECT_EQ(formats, (std::set<std::string>{"OBJ", "OFF", "ASCII STL", "binary STL", "ASCII PLY",
                                            "binary PLY", "binary PLY, big-endian", "VTP"}));
}

TEST(ReadMesh, TakesACoordinateBelowAllDoublesAsZeroAndSaysSo) {
  const MeshFile file = read_text("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 1e-400\nf 1 2 3\n");
  EXPECT_EQ(file.mesh.vertices(2, 2), 0.0);
  EXPECT_TRUE(warns(file, "too small"));
}

TEST(ReadObj, TakesTexturesNegativeIndicesContinuationsAndColours) {
  const std::string text =
      "# made by C:\\tools\\\nmtllib ../../../etc/passwd\no liver\nv 0 0 0 1.0\nv 1 0 0 0.5 0.5 "
      "0.5\nv 1 1 0\nv 0 1 \\\n0\nvt 0 0\nf 1/1 "
      "2/1/1 \\\n3//1\n"
      "f -4/ -2/ -1/\n";
  const MeshFile file = read_text("a.obj", text);
  EXPECT_EQ(file.mesh.vertices.row(3), Vec3(0, 1, 0).transpose());
  EXPECT_EQ(faces_of(file), (Faces{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_TRUE(file.warnings.empty());
}

TEST(ReadMesh, CutsConvexPolygonsIntoFans) {
  EXPECT_EQ(faces_of(read_text("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")),
            (Faces{{0, 1, 2}, {0, 2, 3}}));
}

// An arrowhead with its notch at corner 2: from corner 0 or 2 it is seen as a whole, from its barbs
// 1 and 3 it is not.
TEST(ReadMesh, StartsTheFanWhereThePolygonIsSeenAsAWhole) {
  const std::string barb_first = "v 2 -1 0\nv 0.5 0 0\nv 2 1 0\nv 0 0 0\nf 1 2 3 4\n";
  EXPECT_EQ(faces_of(read_text("a.obj", barb_first)), (Faces{{1, 2, 3}, {1, 3, 0}}));
}

TEST(ReadMesh, TurnsTheFewestFacesRoundSoThatNeighboursAgree) {
  const std::string strip =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nf 1 3 2\nf 1 3 4\nf 2 5 3\n";
  const MeshFile file = read_text("a.obj", strip);
  EXPECT_EQ(faces_of(file), (Faces{{0, 1, 2}, {0, 2, 3}, {1, 4, 2}}));
  EXPECT_TRUE(warns(file, "1 triangle was turned round"));
}

TEST(ReadMesh, LeavesAMoebiusStripAsItIsAndSaysSo) {
  // Five triangles in a ring: vertices i, i+1, i+2 modulo 5, which is the smallest one-sided strip.
  const std::string strip =
      "v 1 0 0\nv 0.3 0.9 0.2\nv -0.8 0.6 -0.1\nv -0.8 -0.6 0.3\nv 0.3 -0.9 -0.2\nf 1 2 3\nf 3 2 "
      "4\nf 3 4 5\nf 5 4 1\nf 5 1 2\n";
  const MeshFile file = read_text("a.obj", strip);
  EXPECT_EQ(faces_of(file), (Faces{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 0}, {4, 0, 1}}));
  EXPECT_TRUE(warns(file, "cannot be oriented"));
}

TEST(ReadMesh, SaysThatAClosedSurfaceIsInsideOut) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  EXPECT_TRUE(
      read_text("a.obj", vertices + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n").warnings.empty());
  EXPECT_TRUE(
      warns(read_text("a.obj", vertices + "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n"), "look inward"));
}

TEST(ReadMesh, DropsUnusedVerticesAndSaysSo) {
  const MeshFile file =
      read_text("a.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 9 9 9\nv 1 1 0\nf 2 3 5\n");
  EXPECT_EQ(file.mesh.vertices.rows(), 3);
  EXPECT_EQ(faces_of(file), (Faces{{0, 1, 2}}));
  EXPECT_TRUE(warns(file, "2 vertices belong to no face"));
}

// The square with a seam along its diagonal: corners 0 and 2 are there twice.
TEST(ReadMesh, JoinsVerticesAtOnePlaceOnlyOnRequest) {
  const std::string seam =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 -0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n";
  const MeshFile apart = read_text("a.obj", seam);
  EXPECT_EQ(apart.mesh.vertices.rows(), 6);
  EXPECT_TRUE(warns(apart, "2 vertices have the same coordinates"));
  const MeshFile joined = read_text("a.obj", seam, {.weld_equal_vertices = true});
  EXPECT_EQ(joined.mesh.vertices.rows(), 4);
  EXPECT_EQ(faces_of(joined), (Faces{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_TRUE(warns(joined, "2 vertices were joined"));
}

TEST(LengthUnit, KnowsThreeNames) {
  EXPECT_EQ(length_unit("mm"), LengthUnit::Millimetre);
  EXPECT_EQ(length_unit("cm"), LengthUnit::Centimetre);
  EXPECT_EQ(length_unit("m"), LengthUnit::Metre);
  EXPECT_THROW(length_unit("inch"), InvalidInput);
}

/// A strip of triangles whose coordinates are random values in the unit, as read_mesh makes them.
TriangleMesh random_strip(LengthUnit unit) {
  const TemporaryFolder folder;
  Random random(7);
  std::string text;
  for (int i = 0; i < 300; ++i)
    text += "v " + text_of(i + random.uniform()) + " " + text_of(100 * random.uniform()) + " " +
            text_of(random.normal()) + "\n";
  for (int i = 1; i + 2 <= 300; ++i)
    text += "f " + std::to_string(i) + " " + std::to_string(i + 1 + i % 2) + " " +
            std::to_string(i + 2 - i % 2) + "\n";
  return read_mesh_of_any_size(folder.file("strip.obj", text), unit).mesh;
}

TEST(WriteMesh, GivesBackTheSameDoublesInTheSameUnit) {
  const TemporaryFolder folder;
  for (const LengthUnit unit :
       {LengthUnit::Millimetre, LengthUnit::Centimetre, LengthUnit::Metre}) {
    const TriangleMesh mesh = random_strip(unit);
    for (const std::string name : {"a.ply", "a.obj", "a.off"}) {
      write_mesh(folder.path() / name, mesh, unit);
      const TriangleMesh again = read_mesh_of_any_size(folder.path() / name, unit).mesh;
      EXPECT_EQ(again.vertices, mesh.vertices) << name;
      EXPECT_EQ(again.triangles, mesh.triangles) << name;
    }
  }
}

TEST(WriteMesh, WritesStlInFloats) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = random_strip(LengthUnit::Millimetre);
  write_mesh(folder.path() / "a.stl", mesh, LengthUnit::Millimetre);
  const TriangleMesh again =
      read_mesh_of_any_size(folder.path() / "a.stl", LengthUnit::Millimetre).mesh;
  ASSERT_EQ(again.vertices.rows(), mesh.vertices.rows());
  // Coordinates reach 300 mm: half a unit in a float's last place there is 1.6e-5 mm. Vertices come
  // in the order of the facets that use them.
  for (Eigen::Index face = 0; face < mesh.triangles.rows(); ++face) {
    for (int i = 0; i < 3; ++i) {
      const double error = (again.vertices.row(again.triangles(face, i)) -
                            mesh.vertices.row(mesh.triangles(face, i)))
                               .cwiseAbs()
                               .maxCoeff();
      EXPECT_LE(error, 1.6e-8);
    }
  }
}

TEST(WriteMesh, RefusesWhatItCannotWrite) {
  const TemporaryFolder folder;
  TriangleMesh mesh = random_strip(LengthUnit::Metre);
  EXPECT_THROW(write_mesh(folder.path() / "a.xyz", mesh, LengthUnit::Metre), InvalidInput);
  EXPECT_THROW(write_mesh(folder.path() / "none" / "a.ply", mesh, LengthUnit::Metre), WriteError);
  mesh.triangles(0, 0) = 300;
  EXPECT_THROW(write_mesh(folder.path() / "a.ply", mesh, LengthUnit::Metre), InvalidInput);
}

TEST(ReadMesh, ReadsARealLiver) {
  const std::filesystem::path path = PALPATION_SOURCE_DIR "/../shared/data/meshes/liver-smooth.obj";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
  const MeshFile file = read_mesh(path, LengthUnit::Centimetre);
  EXPECT_EQ(file.mesh.vertices.rows(), 2194);
  EXPECT_EQ(file.mesh.triangles.rows(), 4384);
  EXPECT_NEAR(extent_m(file.mesh), 0.064, 0.001);  // its README says 6.4 units, rounded
}

}  // namespace
}  // namespace palpation
