// What `palpate info` says of meshes that are odd or broken: what it means, and what to do.
#include <gtest/gtest.h>

#include "io/memory_file.h"
#include "io/mesh_catalogue.h"
#include "io/mesh_seeds.h"
#include "io/temporary_folder.h"
#include "tool/commands.h"

namespace palpation::tool {
namespace {

std::string info_on(const std::filesystem::path& path, const std::string& unit = "cm") {
  ::testing::internal::CaptureStdout();
  try {
    info({.file = path, .unit = unit, .overrides = {}});
  } catch (...) {
    ::testing::internal::GetCapturedStdout();
    throw;
  }
  return ::testing::internal::GetCapturedStdout();
}

std::string info_on_text(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  return info_on(folder.file(name, text));
}

void expect_words(const std::string& words, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_TRUE(contains(words, part)) << part << "\n" << words;
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";

TEST(MeshInfo, DescribesSoundTissueWithoutAWarning) {
  const std::string words = info_on_text("a.obj", kSquare);
  expect_words(words, {"OBJ, 4 vertices, 2 triangles, 10.00 x 10.00 x 0.00 mm",
                       "1 component, 1 border", "Area: 1.000 cm2", "Flat"});
  EXPECT_FALSE(contains(words, "Warning: "));
  EXPECT_FALSE(contains(words, "Welded"));
}

// A mesh is readable or it is not: whatever the catalogue accepts is described, whatever it refuses
// is an error that says what to do.
TEST(MeshInfo, DescribesAllThatCanBeReadAndRefusesTheRest) {
  const TemporaryFolder folder;
  for (const catalogue::MeshCase& example : catalogue::mesh_cases()) {
    SCOPED_TRACE(example.row + ", " + example.name + ", " + example.file);
    const MemoryFile file(folder, example.file);
    const std::filesystem::path& path = file.with(example.bytes);
    try {
      const std::string words = info_on(path);
      EXPECT_FALSE(std::holds_alternative<catalogue::Refused>(example.expected));
      EXPECT_EQ(contains(words, "Not a surface"),
                std::holds_alternative<catalogue::NoSurface>(example.expected))
          << words;
      EXPECT_TRUE(contains(words, "Next:")) << words;
    } catch (const IoError& error) {
      EXPECT_TRUE(std::holds_alternative<catalogue::Refused>(example.expected)) << error.what();
      expect_words(error.what(), {"Repair the file at that place", "or export it again"});
    }
  }
}

TEST(MeshInfo, SaysWhatEachFaultMeansAndHowManyThereAre) {
  const std::string wings = kSquare + "v 0 0 1\nv 0 0 -1\nf 1 3 5\nf 1 3 6\n";
  expect_words(info_on_text("a.obj", wings),
               {"edge between vertices 0 and 2", "1 edge is in more than two triangles",
                "Delete the triangles", "mesh editor"});
  const std::string bow_tie = kSquare + "v -1 0 0\nv -1 -1 0\nf 1 5 6\n";
  expect_words(info_on_text("a.obj", bow_tie), {"vertex 0 at (0, 0, 0)", "1 vertex joins parts",
                                                "Give each part a vertex of its own"});
  const std::string flat = kSquare + "v 2 0 0\nv 3 0 0\nf 2 1 5\nf 5 2 6\n";
  expect_words(info_on_text("a.obj", flat),
               {"2 triangles have no area", "palpate mesh repair --drop-degenerate"});
  const std::string strip =
      "v 1 0 0\nv 0.3 0.9 0.2\nv -0.8 0.6 -0.1\nv -0.8 -0.6 0.3\nv 0.3 -0.9 -0.2\nf 1 2 3\nf 3 2 "
      "4\nf 3 4 5\nf 5 4 1\nf 5 1 2\n";
  expect_words(info_on_text("a.obj", strip),
               {"opposite directions", "cannot be faced the same way", "Moebius"});
}

TEST(MeshInfo, CountsNoFaultsOfAMeshTooLargeForAreas) {
  const std::string words = info_on_text("a.obj", "v 0 0 0\nv 1e300 0 0\nv 0 1e300 0\nf 1 2 3\n");
  expect_words(words, {"Implausible size", "between 1e-60 and 1e60 m"});
  EXPECT_FALSE(contains(words, "no area"));
}

// The square with a seam along its diagonal, as programs write that give every face corners of its
// own.
const std::string kSeam =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n";

TEST(MeshInfo, FindsOutWhatWeldingWouldDo) {
  expect_words(
      info_on_text("a.obj", kSeam),
      {"2 components", "Welded, it is a surface of 1 component with 1 border", "surface.weld"});
  // Three sheets that meet in an edge, each with vertices of its own: a surface of three components
  // apart, and none joined.
  const std::string sheets = kSeam + "v 0 0 0\nv 1 1 0\nv 0 0 1\nf 7 8 9\n";
  expect_words(
      info_on_text("a.obj", sheets),
      {"3 components", "Welding its vertices would not make it a surface", "in 3: 0, 1, 2"});
  // The same face twice, apart by its numbers only.
  expect_words(info_on_text("a.obj", kSquare + "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 5 6 7\n"),
               {"Welding its vertices would not make it a surface", "corners of face 1 again"});
  // A bow-tie whose middle is two vertices where it should be, and one where it should not: only
  // welding the one seam mends nothing else.
  const std::string broken =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -1 0 0\nv -1 -1 0\nv 0 1 0\nv -1 0 0\nv 0 0 0\nf 1 2 3\nf 1 4 "
      "5\nf 8 6 7\n";
  expect_words(
      info_on_text("a.obj", broken),
      {"Not a surface", "vertex 0", "Welded, it is a surface of 1 component with 1 border"});
}

TEST(MeshInfo, ListsComponentsAndBorders) {
  const std::string two = kSquare + "v 5 0 0\nv 6 0 0\nv 6 1 0\nf 5 6 7\n";
  expect_words(info_on_text("a.obj", two),
               {"in 2 components, which share no edge", "Components, the largest first",
                "1.000 cm2, 2 triangles", "0.500 cm2, 1 triangles"});
  // A square of 3 x 3 cells without the one in the middle.
  std::string ring;
  for (int i = 0; i < 16; ++i)
    ring += "v " + std::to_string(i % 4) + " " + std::to_string(i / 4) + " 0\n";
  for (const int corner : {1, 2, 3, 5, 7, 9, 10, 11}) {
    ring += "f " + std::to_string(corner) + " " + std::to_string(corner + 1) + " " +
            std::to_string(corner + 5) + " " + std::to_string(corner + 4) + "\n";
  }
  expect_words(info_on_text("a.obj", ring),
               {"2 borders, Euler number 0", "Borders, the longest first",
                "120.000 mm, 12 vertices", "40.000 mm, 4 vertices"});
}

TEST(MeshInfo, SaysWhereASurfaceIntersectsItself) {
  const std::string crossing = kSquare + "v -0.4 0.3 -1\nv 0.8 0.3 -1\nv 0.5 0.3 1\nf 5 6 7\n";
  expect_words(info_on_text("a.obj", crossing), {"self-intersects: 2 pairs of triangles",
                                                 "triangles 0 and 2", "Delete one of the sheets"});
  EXPECT_FALSE(contains(info_on_text("a.off", catalogue::off_of(catalogue::tetrahedron())),
                        "self-intersect"));
}

TEST(MeshInfo, AdvisesOnWarnings) {
  expect_words(
      info_on_text("a.obj", "v 9 9 9\n" + std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n")),
      {"1 vertices belong to no face", "Harmless"});
  expect_words(
      info_on_text("a.off", catalogue::off_of({catalogue::tetrahedron().points,
                                               {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}}})),
      {"look inward", "Flip all faces"});
  expect_words(info_on_text("a.obj", kSquare + "v 0 -1e-7 0\nf 2 1 5\n"),
               {"1 triangles are slivers", "the worst is in face 3", "remesh"});
}

TEST(MeshInfo, LeavesTheReasonAloneWhereThereIsNoFile) {
  const std::string message = io_error_of([] { info_on("/no/such/file.obj"); });
  EXPECT_EQ(message, "/no/such/file.obj: cannot read: No such file or directory");
}

}  // namespace
}  // namespace palpation::tool
