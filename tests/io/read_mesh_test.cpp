#include "palpation/io/read_mesh.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstring>

#include "io/temporary_folder.h"
#include "palpation/base/random.h"
#include "palpation/io/atomic_file.h"

namespace palpation {
namespace {

MeshFile read_text(const std::string& name, const std::string& content, const MeshRepair& repair = {}) {
  const TemporaryFolder folder;
  return read_mesh_of_any_size(folder.file(name, content), LengthUnit::Metre, repair);
}

/// The message, from the file's name on.
std::string error_of(const std::string& name, const std::string& content) {
  const std::string message = io_error_of([&] { read_text(name, content); });
  const std::size_t start = message.find("/" + name);
  EXPECT_NE(start, std::string::npos) << message;
  return start == std::string::npos ? message : message.substr(start + 1);
}

template <typename Number>
std::string bytes_of(Number number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

std::string reversed(std::string bytes) { return {bytes.rbegin(), bytes.rend()}; }

std::vector<std::vector<int>> faces_of(const MeshFile& file) {
  std::vector<std::vector<int>> faces;
  for (Eigen::Index i = 0; i < file.mesh.triangles.rows(); ++i) {
    faces.push_back({file.mesh.triangles(i, 0), file.mesh.triangles(i, 1), file.mesh.triangles(i, 2)});
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

// A unit square of two triangles: corners 0 (0,0), 1 (1,0), 2 (1,1), 3 (0,1), faces 0 1 2 and 0 2 3, in every format.
const std::string kObj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
const std::string kOff = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
const std::string kPlyHeader =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\nproperty list uchar int "
    "vertex_indices\nend_header\n";
const std::string kAsciiPly = "ply\nformat ascii 1.0\n" + kPlyHeader + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
const std::string kAsciiStl =
    "solid square\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n"
    "facet normal 0 0 1\nouter loop\nvertex 0 0 -0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid square\n";
const std::string kVtpHead =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n";

std::string vtp(const std::string& count, const std::string& components, const std::string& connectivity, const std::string& offsets,
                const std::string& point_data = "") {
  return kVtpHead + "<Piece NumberOfPoints=\"" + count + "\" NumberOfPolys=\"2\">\n" + point_data +
         "<Points><DataArray type=\"Float64\" NumberOfComponents=\"" + components +
         "\" format=\"ascii\">0 0 0 1 0 0 1 1 0 0 1 0.1</DataArray></Points>\n<Polys><DataArray type=\"Int64\" Name=\"connectivity\" "
         "format=\"ascii\">" +
         connectivity + "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" + offsets +
         "</DataArray></Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}
const std::string kVtp = vtp("4", "3", "0 1 2 0 2 3", "3 6");

std::string binary_ply(bool big) {
  const auto ordered = [big](const std::string& bytes) { return big ? reversed(bytes) : bytes; };
  std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + kPlyHeader;
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f}) bytes += ordered(bytes_of(x));
  for (const std::vector<std::int32_t>& face : {std::vector<std::int32_t>{0, 1, 2}, {0, 2, 3}}) {
    bytes += '\3';
    for (const std::int32_t index : face) bytes += ordered(bytes_of(index));
  }
  return bytes;
}

std::string binary_stl(const std::string& title, std::uint32_t count) {
  std::string bytes = title + std::string(80 - title.size(), ' ') + bytes_of(count);
  for (const std::vector<float>& facet :
       {std::vector<float>{0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0}, {0, 0, 1, -0.f, 0, 0, 1, 1, 0, 0, 1, 0}}) {
    for (const float x : facet) bytes += bytes_of(x);
    bytes += std::string(2, '\0');
  }
  return bytes;
}

void expect_square(const MeshFile& file, const std::string& format) {
  EXPECT_EQ(file.format, format);
  ASSERT_EQ(file.mesh.vertices.rows(), 4) << format;
  EXPECT_EQ(file.mesh.vertices.row(2), Vec3(1, 1, 0).transpose()) << format;
  EXPECT_EQ(faces_of(file), (Faces{{0, 1, 2}, {0, 2, 3}})) << format;
  EXPECT_TRUE(file.warnings.empty()) << file.warnings.front().text;
}

TEST(ReadMesh, ReadsTheSameSquareFromEveryFormat) {
  expect_square(read_text("a.obj", kObj), "OBJ");
  expect_square(read_text("a.off", kOff), "OFF");
  expect_square(read_text("a.ply", kAsciiPly), "ASCII PLY");
  expect_square(read_text("a.ply", binary_ply(false)), "binary PLY");
  expect_square(read_text("a.ply", binary_ply(true)), "binary PLY, big-endian");
  expect_square(read_text("a.stl", kAsciiStl), "ASCII STL");
  expect_square(read_text("a.stl", binary_stl("", 2)), "binary STL");
  expect_square(read_text("a.vtp", kVtp), "VTP");
}

TEST(ReadMesh, GoesByContentAndSaysThatTheNameMisleads) {
  const MeshFile file = read_text("a.obj", kOff);
  EXPECT_EQ(file.format, "OFF");
  EXPECT_TRUE(warns(file, "named .obj but holds OFF"));
  EXPECT_EQ(read_text("a.stl", binary_stl("solid from a careless writer", 2)).format, "binary STL");
  EXPECT_TRUE(contains(error_of("a.txt", "shopping: milk, eggs"), "none of OBJ, OFF, STL, PLY and VTP"));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
  return text;
}

TEST(ReadMesh, TakesEveryLineEndAndAByteOrderMark) {
  for (const std::string end : {"\r\n", "\r"}) {
    expect_square(read_text("a.obj", replaced(kObj, "\n", end)), "OBJ");
    expect_square(read_text("a.off", replaced(kOff, "\n", end)), "OFF");
    expect_square(read_text("a.ply", replaced(kAsciiPly, "\n", end)), "ASCII PLY");
    expect_square(read_text("a.stl", replaced(kAsciiStl, "\n", end)), "ASCII STL");
  }
  expect_square(read_text("a.obj", "\xEF\xBB\xBF" + kObj), "OBJ");
}

TEST(ReadMesh, ReadsTheDecimalPointInAnyLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // where it is not installed, the second claim still holds
  EXPECT_EQ(read_text("a.obj", replaced(kObj, "v 1 1 0", "v 1.5 1 0")).mesh.vertices(2, 0), 1.5);
  EXPECT_TRUE(contains(error_of("a.obj", replaced(kObj, "v 1 1 0", "v 1,5 1 0")), "a.obj:3: vertex 3: x = \"1,5\" is not a number"));
  std::setlocale(LC_ALL, before.c_str());
}

// Cut anywhere, a file is an error, or it is whole: nothing in between. OBJ has no counts, so a cut between two faces cannot be seen, and
// one inside the last face is told by a warning.
TEST(ReadMesh, NeverTakesATruncatedFileForAWholeOne) {
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.off", kOff},      {"a.ply", kAsciiPly},         {"a.ply", binary_ply(false)},      {"a.ply", binary_ply(true)},
      {"a.stl", kAsciiStl}, {"a.stl", binary_stl("", 2)}, {"a.stl", binary_stl("solid", 2)}, {"a.vtp", kVtp}};
  const TemporaryFolder folder;
  for (const auto& [name, whole] : files) {
    for (std::size_t length = 0; length < whole.size(); ++length) {
      const std::filesystem::path path = folder.file(name, whole.substr(0, length));
      try {
        const MeshFile file = read_mesh_of_any_size(path, LengthUnit::Metre);
        EXPECT_EQ(faces_of(file), (Faces{{0, 1, 2}, {0, 2, 3}})) << name << " cut after " << length;
      } catch (const IoError& error) {
        EXPECT_TRUE(contains(error.what(), path.string())) << error.what();
      }
    }
  }
  EXPECT_TRUE(warns(read_text("a.obj", kObj.substr(0, kObj.size() - 1)), "no line end"));
}

TEST(ReadMesh, NamesThePathOfAFileThatCannotBeRead) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& name) { return io_error_of([&] { read_mesh(folder.path() / name, LengthUnit::Metre); }); };
  EXPECT_TRUE(contains(read("none.obj"), "none.obj: cannot read: No such file"));
  EXPECT_TRUE(contains(read(""), "is a folder"));
  EXPECT_TRUE(contains(error_of("a.obj", ""), "empty"));
}

TEST(ReadMesh, RefusesVerticesWithoutFacesAndFacesWithoutVertices) {
  EXPECT_TRUE(contains(error_of("a.obj", "v 0 0 0\n"), "no faces"));
  EXPECT_TRUE(contains(error_of("a.obj", "f 1 2 3\n"), "no vertices"));
  EXPECT_TRUE(contains(error_of("a.stl", std::string(84, '\0')), "no vertices"));
  EXPECT_TRUE(contains(error_of("a.off", "OFF\n1 0 0\n0 0 0\n"), "no faces"));
}

TEST(ReadMesh, NamesTheCoordinateThatIsNotFinite) {
  EXPECT_TRUE(contains(error_of("a.obj", "v 0 0 0\nv 1 nan 0\n"), "a.obj:2: vertex 2: y = \"nan\" is not finite"));
  EXPECT_TRUE(contains(error_of("a.obj", "v 0 0 1e400\n"), "a.obj:1: vertex 1: z = \"1e400\" is too large"));
  EXPECT_TRUE(contains(error_of("a.off", replaced(kOff, "1 1 0", "1 inf 0")), "a.off:5: vertex 2: y = \"inf\" is not finite"));
  EXPECT_TRUE(contains(error_of("a.ply", replaced(kAsciiPly, "1 1 0", "1 nan 0")), "vertex 2: y = nan is not finite"));
  std::string stl = binary_stl("", 2);
  stl.replace(84 + 12 + 4, 4, bytes_of(NAN));
  EXPECT_TRUE(contains(error_of("a.stl", stl), "a.stl, byte 100: facet 0: y = nan is not finite"));
  EXPECT_FALSE(error_of("a.vtp", replaced(kVtp, "0.1", "nan")).empty());  // VTK itself reads no such word
}

TEST(ReadMesh, TakesACoordinateBelowAllDoublesAsZeroAndSaysSo) {
  const MeshFile file = read_text("a.obj", replaced(kObj, "v 1 1 0", "v 1 1 1e-400"));
  EXPECT_EQ(file.mesh.vertices(2, 2), 0.0);
  EXPECT_TRUE(warns(file, "too small"));
}

TEST(ReadObj, TakesTexturesNegativeIndicesContinuationsAndColours) {
  const std::string text =
      "# made by C:\\tools\\\nmtllib ../../../etc/passwd\no liver\nv 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nv 0 1 \\\n0\nvt 0 0\nf 1/1 "
      "2/1/1 \\\n3//1\n"
      "f -4/ -2/ -1/\n";
  expect_square(read_text("a.obj", text), "OBJ");
}

TEST(ReadObj, TakesIndicesOfVerticesThatFollow) { expect_square(read_text("a.obj", "f 1 2 3\nf 1 3 4\n" + kObj.substr(0, 32)), "OBJ"); }

TEST(ReadObj, NamesTheIndexOutOfRange) {
  const std::string vertices = kObj.substr(0, 32);
  EXPECT_TRUE(contains(error_of("a.obj", vertices + "f 1 2 0\n"), "a.obj:5: face 1: corner \"0\" has the vertex index 0"));
  EXPECT_TRUE(contains(error_of("a.obj", vertices + "f 1 2 5\n"), "a.obj:5: face 1: vertex index 5 is out of range 1 to 4"));
  EXPECT_TRUE(contains(error_of("a.obj", vertices + "f 1 2 -5\n"), "corner \"-5\" counts back beyond"));
  EXPECT_TRUE(contains(error_of("a.obj", vertices + "f 1 2 2147483648\n"), "out of range"));
  EXPECT_TRUE(contains(error_of("a.obj", vertices + "f 1 2 1e20\n"), "\"1e20\" is not of the form"));
  EXPECT_TRUE(contains(error_of("a.obj", vertices + "f 1 2 99999999999999999999\n"), "is not of the form"));
  EXPECT_TRUE(contains(error_of("a.obj", vertices + "f 1 2 3/x\n"), "\"3/x\" is not of the form"));
}

TEST(ReadObj, RefusesMissingCoordinatesUnknownWordsAndNulBytes) {
  EXPECT_TRUE(contains(error_of("a.obj", "v 0 0\n"), "a.obj:1: vertex 1 has 2 coordinates"));
  EXPECT_TRUE(contains(error_of("a.obj", "v\n"), "has 0 coordinates"));
  EXPECT_TRUE(contains(error_of("a.obj", kObj + "vertex 1 2 3\n"), "a.obj:7: \"vertex\" is no statement"));
  EXPECT_TRUE(contains(error_of("a.obj", kObj + std::string(1, '\0')), "byte 48: a NUL"));
  EXPECT_TRUE(contains(error_of("a.obj", kObj + "f 1 2 \\"), "the file ends"));
}

TEST(ReadObj, TakesALineOfMegabytes) { expect_square(read_text("a.obj", "# " + std::string(5'000'000, 'x') + "\n" + kObj), "OBJ"); }

TEST(ReadMesh, CutsConvexPolygonsIntoFans) {
  EXPECT_EQ(faces_of(read_text("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")), (Faces{{0, 1, 2}, {0, 2, 3}}));
}

// An arrowhead with its notch at corner 2: from corner 0 or 2 it is seen as a whole, from its barbs 1 and 3 it is not.
TEST(ReadMesh, StartsTheFanWhereThePolygonIsSeenAsAWhole) {
  const std::string barb_first = "v 2 -1 0\nv 0.5 0 0\nv 2 1 0\nv 0 0 0\nf 1 2 3 4\n";
  EXPECT_EQ(faces_of(read_text("a.obj", barb_first)), (Faces{{1, 2, 3}, {1, 3, 0}}));
}

TEST(ReadMesh, RefusesPolygonsThatNoFanCovers) {
  // A comb of two teeth pointing up, with barbs at the bottom: no corner sees all.
  const std::string zigzag = "v 0 0 0\nv 6 0 0\nv 6 4 0\nv 5 4 0\nv 5 1 0\nv 1 1 0\nv 1 4 0\nv 0 4 0\nf 1 2 3 4 5 6 7 8\n";
  EXPECT_TRUE(contains(error_of("a.obj", zigzag), "a.obj:9: face 1: is a polygon that no fan"));
  std::string vertices, face = "f";
  for (int i = 1; i <= 300; ++i) {
    vertices += "v " + std::to_string(std::cos(i * 0.02)) + " " + std::to_string(std::sin(i * 0.02)) + " 0\n";
    face += " " + std::to_string(i);
  }
  EXPECT_TRUE(contains(error_of("a.obj", vertices + face + "\n"), "has more than 256 corners"));
}

TEST(ReadMesh, RefusesFacesWithTooFewOrRepeatedCorners) {
  EXPECT_TRUE(contains(error_of("a.obj", kObj + "f\n"), "a.obj:7: face 3: has 0 corners"));
  EXPECT_TRUE(contains(error_of("a.obj", kObj + "f 1 2\n"), "face 3: has 2 corners"));
  EXPECT_TRUE(contains(error_of("a.obj", kObj + "f 1 2 1\n"), "face 3: uses vertex 1 twice"));
  EXPECT_TRUE(contains(error_of("a.off", replaced(kOff, "3 0 1 2", "1 0")), "a.off:7: face 0: has 1 corners"));
}

TEST(ReadMesh, RefusesAFaceGivenTwiceEvenTurnedRound) {
  EXPECT_TRUE(contains(error_of("a.obj", kObj + "f 2 3 1\n"), "a.obj:7: face 3: has the corners of face 1 again"));
  EXPECT_TRUE(contains(error_of("a.obj", kObj + "f 3 2 1\n"), "face 3: has the corners of face 1 again"));
}

TEST(ReadMesh, TurnsTheFewestFacesRoundSoThatNeighboursAgree) {
  const std::string strip = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nf 1 3 2\nf 1 3 4\nf 2 5 3\n";
  const MeshFile file = read_text("a.obj", strip);
  EXPECT_EQ(faces_of(file), (Faces{{0, 1, 2}, {0, 2, 3}, {1, 4, 2}}));
  EXPECT_TRUE(warns(file, "1 triangles were turned round"));
}

TEST(ReadMesh, LeavesAMoebiusStripAsItIsAndSaysSo) {
  // Five triangles in a ring: vertices i, i+1, i+2 modulo 5, which is the smallest one-sided strip.
  const std::string strip =
      "v 1 0 0\nv 0.3 0.9 0.2\nv -0.8 0.6 -0.1\nv -0.8 -0.6 0.3\nv 0.3 -0.9 -0.2\nf 1 2 3\nf 3 2 4\nf 3 4 5\nf 5 4 1\nf 5 1 2\n";
  const MeshFile file = read_text("a.obj", strip);
  EXPECT_EQ(faces_of(file), (Faces{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 0}, {4, 0, 1}}));
  EXPECT_TRUE(warns(file, "cannot be oriented"));
}

TEST(ReadMesh, SaysThatAClosedSurfaceIsInsideOut) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  EXPECT_TRUE(read_text("a.obj", vertices + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n").warnings.empty());
  EXPECT_TRUE(warns(read_text("a.obj", vertices + "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n"), "look inward"));
}

TEST(ReadMesh, DropsUnusedVerticesAndSaysSo) {
  const MeshFile file = read_text("a.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 9 9 9\nv 1 1 0\nf 2 3 5\n");
  EXPECT_EQ(file.mesh.vertices.rows(), 3);
  EXPECT_EQ(faces_of(file), (Faces{{0, 1, 2}}));
  EXPECT_TRUE(warns(file, "2 vertices belong to no face"));
}

// The square with a seam along its diagonal: corners 0 and 2 are there twice.
TEST(ReadMesh, JoinsVerticesAtOnePlaceOnlyOnRequest) {
  const std::string seam = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 -0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n";
  const MeshFile apart = read_text("a.obj", seam);
  EXPECT_EQ(apart.mesh.vertices.rows(), 6);
  EXPECT_TRUE(warns(apart, "2 vertices have the same coordinates"));
  const MeshFile joined = read_text("a.obj", seam, {.weld_equal_vertices = true});
  EXPECT_EQ(joined.mesh.vertices.rows(), 4);
  EXPECT_EQ(faces_of(joined), (Faces{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_TRUE(warns(joined, "2 vertices were joined"));
}

TEST(ReadMesh, ListsAPairOfNearDuplicates) {
  const MeshFile file = read_text("a.obj", kObj + "v 1 1e-13 0\nv 2 0 0\nv 2 1 0\nf 5 6 7\n");
  EXPECT_TRUE(warns(file, "1 vertices have a near-duplicate within 1e-12 of the extent, such as vertices 1 and 4"));
}

TEST(ReadMesh, RefusesCountsThatTheBytesCannotHold) {
  for (const std::string count : {"2147483648", "4294967300", "10000000000", "9223372036854775807"}) {
    EXPECT_TRUE(contains(error_of("a.off", replaced(kOff, "4 2 0", count + " 2 0")), "a.off:2: " + count + " vertices do not fit"))
        << count;
    EXPECT_TRUE(contains(error_of("a.off", replaced(kOff, "4 2 0", "4 " + count + " 0")), "do not fit")) << count;
    EXPECT_TRUE(contains(error_of("a.ply", replaced(kAsciiPly, "vertex 4", "vertex " + count)), "a.ply:3: " + count)) << count;
    EXPECT_TRUE(contains(error_of("a.ply", replaced(binary_ply(false), "face 2", "face " + count)), "do not fit")) << count;
    EXPECT_TRUE(contains(error_of("a.vtp", vtp(count, "3", "0 1 2 0 2 3", "3 6")), "a.vtp")) << count;
  }
  EXPECT_TRUE(contains(error_of("a.off", replaced(kOff, "4 2 0", "-4 2 0")), "\"-4\" is not a count"));
  EXPECT_TRUE(contains(error_of("a.off", replaced(kOff, "4 2 0", "four 2 0")), "\"four\" is not a count"));
  EXPECT_TRUE(contains(error_of("a.ply", replaced(kAsciiPly, "vertex 4", "vertex -4")), "\"-4\" is not a count"));
  EXPECT_TRUE(contains(error_of("a.stl", binary_stl("", 0x80000000u)), "2147483648 facets make 107374182484 bytes, but the file has 184"));
  EXPECT_TRUE(contains(error_of("a.stl", binary_stl("", 2) + "vendor"), "but the file has 190"));
}

TEST(ReadOff, RefusesMoreOrFewerLinesThanItsCounts) {
  EXPECT_TRUE(contains(error_of("a.off", kOff + "3 0 1 3\n"), "a.off:9: more lines"));
  EXPECT_TRUE(contains(error_of("a.off", replaced(kOff, "4 2 0", "4 3 0")), "the file ends where face 2 is expected"));
  EXPECT_TRUE(
      contains(error_of("a.off", replaced(kOff, "3 0 2 3", "3 0 2 4")), "a.off:8: face 1: vertex index \"4\" is out of range 0 to 3"));
  EXPECT_TRUE(contains(error_of("a.off", replaced(kOff, "3 0 2 3", "1000000000 0 2 3")), "1000000000 corners; at most 256"));
}

TEST(ReadStl, NamesTheLineWhereAKeywordIsMissing) {
  EXPECT_TRUE(contains(error_of("a.stl", replaced(kAsciiStl, "endfacet\n", "")), "a.stl:8: facet 0: \"endfacet\" is expected"));
  EXPECT_TRUE(contains(error_of("a.stl", replaced(kAsciiStl, "endloop\n", "")), "a.stl:7: facet 0: \"endloop\" is expected"));
  EXPECT_TRUE(contains(error_of("a.stl", replaced(kAsciiStl, "endsolid square\n", "")), "the file ends where facet or endsolid"));
  EXPECT_TRUE(
      contains(error_of("a.stl", replaced(kAsciiStl, "vertex 1 0 0", "vertex 1 0 0\nvertex 2 0 0")), "a.stl:7: facet 0: \"endloop\""));
}

TEST(ReadPly, NamesTheHeaderLineAtFault) {
  EXPECT_TRUE(contains(error_of("a.ply", replaced(kAsciiPly, "float y", "real y")), "a.ply:5: \"real\" is no type"));
  EXPECT_TRUE(
      contains(error_of("a.ply", replaced(kAsciiPly, "property float z\n", "")), "a.ply:3: element \"vertex\" has no number \"z\""));
  EXPECT_TRUE(contains(error_of("a.ply", replaced(kAsciiPly, "format ascii 1.0\n", "")), "no format line"));
  EXPECT_TRUE(contains(error_of("a.ply", replaced(kAsciiPly, "end_header\n", "")), "a.ply:9: \"0\" is no statement"));
  EXPECT_TRUE(contains(error_of("a.ply", replaced(kAsciiPly, "float z", "float y")), "a.ply:6: property \"y\""));
  std::string many;
  for (int i = 0; i < 20000; ++i) many += "property float p" + std::to_string(i) + "\n";
  EXPECT_TRUE(contains(error_of("a.ply", replaced(kAsciiPly, "element face", many + "element face")), "more than 256 properties"));
  EXPECT_TRUE(contains(error_of("a.ply", replaced(kAsciiPly, "float z", "float z" + std::string(100000, 'z'))), "more than 4096 bytes"));
}

TEST(ReadPly, RefusesListsLongerThanTheFile) {
  const std::string ply = binary_ply(false);
  const std::size_t list = ply.size() - 2 * 13;
  std::string long_list = ply;
  long_list[list] = '\xFF';
  EXPECT_TRUE(contains(error_of("a.ply", long_list), "of 255 numbers does not fit"));
  for (const std::string count : {"-1", "2147483647"}) {
    EXPECT_TRUE(contains(error_of("a.ply", replaced(kAsciiPly, "3 0 2 3", count + " 0 2 3")),
                         "\"" + count + "\" is not a whole number that fits its type"))
        << count;
  }
  EXPECT_TRUE(contains(error_of("a.ply", replaced(ply, "little", "big")), "a.ply, byte"));
  EXPECT_TRUE(contains(error_of("a.ply", ply + "x"), "1 bytes more than"));
}

TEST(ReadPly, SkipsOtherElementsPropertiesAndLists) {
  std::string ply = replaced(kAsciiPly, "element face",
                             "property uchar red\nelement edge 1\nproperty list uchar int ends\nproperty float width\nelement face");
  ply = replaced(ply, "0 0 0\n1 0 0\n1 1 0\n0 1 0\n", "0 0 0 9\n1 0 0 9\n1 1 0 9\n0 1 0 9\n2 0 1 0.5\n");
  expect_square(read_text("a.ply", ply), "ASCII PLY");
}

TEST(ReadVtp, RefusesIndicesOffsetsAndArraysThatDoNotFit) {
  EXPECT_TRUE(contains(error_of("a.vtp", vtp("4", "3", "0 1 2 0 2 99", "3 6")), "cell 1 of Polys: vertex index 99 is out of range 0 to 3"));
  EXPECT_TRUE(contains(error_of("a.vtp", vtp("4", "3", "0 1 2 0 2 -7", "3 6")), "vertex index -7"));
  EXPECT_TRUE(contains(error_of("a.vtp", vtp("4", "3", "0 1 2 0 2 1000000000000", "3 6")), "vertex index 1000000000000 is out of range"));
  EXPECT_FALSE(error_of("a.vtp", vtp("4", "3", "0 1 2 0 2 3", "6 3")).empty());
  EXPECT_FALSE(error_of("a.vtp", vtp("4", "3", "0 1 2 0 2 3", "3 600")).empty());
  EXPECT_FALSE(error_of("a.vtp", vtp("4", "2000000000", "0 1 2 0 2 3", "3 6")).empty());
  EXPECT_FALSE(error_of("a.vtp", vtp("4", "2", "0 1 2 0 2 3", "3 6")).empty());
  EXPECT_FALSE(error_of("a.vtp", kVtp.substr(0, 300)).empty());
  const std::string bomb =
      "<?xml version=\"1.0\"?><!DOCTYPE b [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\">]><VTKFile>&b;</VTKFile>";
  EXPECT_FALSE(error_of("a.vtp", bomb).empty());
}

/// The square in base64 and zlib, as VTK writes it; the arguments stand for the connectivity's sizes (AQAAAACAAAAwAAAAFgAAAA== if sound)
/// and format.
std::string compressed_vtp(const std::string& sizes, const std::string& format) {
  return "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\" header_type=\"UInt32\" "
         "compressor=\"vtkZLibDataCompressor\">\n"
         "<!-- made by hand --><PolyData><Piece NumberOfPoints=\"4\" NumberOfPolys=\"2\"><Points><DataArray type=\"Float64\" "
         "NumberOfComponents=\"3\" "
         "format=\"binary\">\nAQAAAACAAABgAAAAFAAAAA==eJxjYMAHPtjjFyckz8AAALNMBL0=\n</DataArray></Points><Polys><DataArray type=\"Int64\" "
         "Name=\"connectivity\" " +
         format + ">\n" + sizes +
         "eJxjYIAARijNxIAKYHxmKA0AANAACQ==\n</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"binary\">\n"
         "AQAAAACAAAAQAAAADgAAAA==eJxjZoAANigNAABwAAo=\n</DataArray></Polys></Piece></PolyData></VTKFile>\n";
}

TEST(ReadVtp, ReadsCompressedBlocks) {
  expect_square(read_text("a.vtp", compressed_vtp("AQAAAACAAAAwAAAAFgAAAA==", "format=\"binary\"")), "VTP");
}

// Each of these makes VTK's parser read outside its buffers, or allocate what the file does not hold.
TEST(ReadVtp, RefusesSizesOfBlocksThatDoNotAddUp) {
  const std::string sound = "AQAAAACAAAAwAAAAFgAAAA==", binary = "format=\"binary\"";
  // Little-endian words: blocks, their size, the size of the last, compressed sizes.
  EXPECT_TRUE(
      contains(error_of("a.vtp", compressed_vtp("AAAAAACAAAAwAAAA", binary)), "0 blocks of 32768 bytes, the last of 48"));  // 0, 32768, 48
  EXPECT_TRUE(contains(error_of("a.vtp", compressed_vtp("/////wCAAAAwAAAAFgAAAA==", binary)), "4294967295 blocks"));
  EXPECT_TRUE(contains(error_of("a.vtp", compressed_vtp("AQAAAACAAAAwAAAA////fw==", binary)), "a block of 2147483647 bytes does not fit"));
  EXPECT_TRUE(contains(error_of("a.vtp", compressed_vtp("AQAAAP///3////9/FgAAAA==", binary)),
                       "2147483647 bytes, but 6 numbers of its type have 48"));
  EXPECT_TRUE(contains(error_of("a.vtp", compressed_vtp(sound, "format=\"appen3ed\" offset=\"0\"")), "an array's format"));
  EXPECT_TRUE(contains(error_of("a.vtp", compressed_vtp(sound, "format=\"binary\" offset=\"0\"")), "an array's format"));
  EXPECT_TRUE(contains(error_of("a.vtp", compressed_vtp(sound, "format=\"&#98;inary\"")), "entities"));
}

TEST(ReadVtp, NamesAnArrayOfTheWrongLength) {
  const std::string array = "<PointData><DataArray type=\"Float64\" Name=\"stiffness\" format=\"ascii\">1 2 3</DataArray></PointData>";
  EXPECT_TRUE(contains(error_of("a.vtp", vtp("4", "3", "0 1 2 0 2 3", "3 6", array)), "stiffness"));
}

TEST(ReadVtp, KeepsDoublePrecision) { EXPECT_EQ(read_text("a.vtp", kVtp).mesh.vertices(3, 2), 0.1); }

TEST(ReadVtp, PrintsNothing) {
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  error_of("a.vtp", vtp("4", "2", "0 1 2 0 2 3", "6 3"));
  error_of("a.vtp", kVtp.substr(0, 300));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

// Whatever bytes are damaged, the answer is a mesh or an IoError: no crash, no hang. (Fuzzing goes further; this is the net below it.)
TEST(ReadMesh, SurvivesDamagedBytes) {
  const std::vector<std::pair<std::string, std::string>> files = {{"a.obj", kObj},
                                                                  {"a.off", kOff},
                                                                  {"a.ply", kAsciiPly},
                                                                  {"a.stl", kAsciiStl},
                                                                  {"a.ply", binary_ply(false)},
                                                                  {"a.stl", binary_stl("", 2)},
                                                                  {"a.vtp", kVtp}};
  const TemporaryFolder folder;
  Random random(1);
  for (const auto& [name, whole] : files) {
    for (int trial = 0; trial < 300; ++trial) {
      std::string damaged = whole;
      for (int i = random.below(4); i >= 0; --i)
        damaged[random.below(static_cast<int>(whole.size()))] = static_cast<char>(random.below(256));
      try {
        const MeshFile file = read_mesh_of_any_size(folder.file(name, damaged), LengthUnit::Metre);
        ASSERT_GT(file.mesh.triangles.rows(), 0);
        ASSERT_LT(file.mesh.triangles.maxCoeff(), file.mesh.vertices.rows());
        ASSERT_GE(file.mesh.triangles.minCoeff(), 0);
        ASSERT_TRUE(file.mesh.vertices.allFinite());
      } catch (const IoError&) {
      }
    }
  }
}

TEST(ReadMesh, RefusesASizeThatNoTissueHasAndSuggestsTheUnit) {
  const TemporaryFolder folder;
  const std::string liver = "v 0 0 0\nv 120 0 0\nv 0 120 0\nf 1 2 3\n";
  const std::filesystem::path path = folder.file("a.obj", liver);
  EXPECT_NEAR(extent_m(read_mesh(path, LengthUnit::Millimetre).mesh), 0.12, 0.0);  // 120 / 1000 is rounded once, to the double 0.12
  const std::string message = io_error_of([&] { read_mesh(path, LengthUnit::Metre); });
  EXPECT_TRUE(contains(message, "read in m the mesh is 120 m long")) << message;
  EXPECT_TRUE(contains(message, "is its unit mm or cm?")) << message;
  EXPECT_EQ(extent_m(read_mesh_of_any_size(path, LengthUnit::Metre).mesh), 120.0);
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
    text += "v " + text_of(i + random.uniform()) + " " + text_of(100 * random.uniform()) + " " + text_of(random.normal()) + "\n";
  for (int i = 1; i + 2 <= 300; ++i)
    text += "f " + std::to_string(i) + " " + std::to_string(i + 1 + i % 2) + " " + std::to_string(i + 2 - i % 2) + "\n";
  return read_mesh_of_any_size(folder.file("strip.obj", text), unit).mesh;
}

TEST(WriteMesh, GivesBackTheSameDoublesInTheSameUnit) {
  const TemporaryFolder folder;
  for (const LengthUnit unit : {LengthUnit::Millimetre, LengthUnit::Centimetre, LengthUnit::Metre}) {
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
  const TriangleMesh again = read_mesh_of_any_size(folder.path() / "a.stl", LengthUnit::Millimetre).mesh;
  ASSERT_EQ(again.vertices.rows(), mesh.vertices.rows());
  // Coordinates reach 300 mm: half a unit in a float's last place there is 1.6e-5 mm. Vertices come in the order of the facets that use
  // them.
  for (Eigen::Index face = 0; face < mesh.triangles.rows(); ++face) {
    for (int i = 0; i < 3; ++i) {
      const double error =
          (again.vertices.row(again.triangles(face, i)) - mesh.vertices.row(mesh.triangles(face, i))).cwiseAbs().maxCoeff();
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
