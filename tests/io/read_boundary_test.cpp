#include "palpation/io/read_boundary.h"

#include <gtest/gtest.h>

#include <string>

#include "io/square.h"
#include "io/temporary_folder.h"

namespace palpation {
namespace {

/// Lines through four points.
std::string lines_through(const std::string& points, int count, const std::string& connectivity,
                          const std::string& offsets, const std::string& cell_data = "") {
  return R"(<VTKFile type="PolyData" version="1.0"><PolyData><Piece NumberOfPoints="4" NumberOfVerts="0" NumberOfLines=")" +
         std::to_string(count) + R"(" NumberOfStrips="0" NumberOfPolys="0">)" + cell_data +
         R"(<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">)" + points +
         R"(</DataArray></Points><Lines><DataArray type="Int64" Name="connectivity" format="ascii">)" +
         connectivity + R"(</DataArray><DataArray type="Int64" Name="offsets" format="ascii">)" +
         offsets + R"(</DataArray></Lines></Piece></PolyData></VTKFile>)";
}

/// One closed line through them all.
std::string line_through(const std::string& points) {
  return lines_through(points, 1, "0 1 2 3 0", "5");
}

const std::string kCorners = "0.005 0.005 0 0.015 0.005 0 0.015 0.015 0 0.005 0.015 0";

BoundaryFile read(const std::string& text) {
  const TemporaryFolder folder;
  return read_boundary_vtp(folder.file("b.vtp", text), square());
}

TEST(ReadBoundary, ReadsALineOnTheTissue) {
  const BoundaryFile file =
      read(line_through("0.005 0.005 0 0.015 0.005 0 0.015 0.015 0 0.005 0.015 0"));
  EXPECT_NEAR(file.region.area(), 1e-4, 1e-18);  // 1 x 1 cm, to a rounding
  EXPECT_TRUE(file.warnings.empty());
}

// As a contour filter leaves them: two points each, in any order, either way round.
TEST(ReadBoundary, JoinsPiecesThatEndInTheSamePlace) {
  const BoundaryFile file = read(lines_through(kCorners, 4, "2 1 0 1 3 0 2 3", "2 4 6 8"));
  EXPECT_NEAR(file.region.area(), 1e-4, 1e-18);
  EXPECT_TRUE(file.warnings.empty());
}

TEST(ReadBoundary, RefusesALineThatDoesNotClose) {
  const std::string words = io_error_of([] { read(lines_through(kCorners, 2, "0 1 2 3", "2 4")); });
  EXPECT_TRUE(
      contains(words, "b.vtp: line 0 ends at (0.015, 0.005, 0) m, and no other goes on there"))
      << words;
}

TEST(ReadBoundary, RefusesLinesAroundNoArea) {
  const std::string words = io_error_of([] { read(lines_through(kCorners, 2, "0 1 1 0", "2 4")); });
  EXPECT_TRUE(contains(words, "no area is inside its 1 closed lines")) << words;
}

TEST(ReadBoundary, WarnsWhereNoLineIsOfTheEstimate) {
  const BoundaryFile file = read(lines_through(
      kCorners, 1, "0 1 2 3 0", "5",
      R"(<CellData><DataArray type="String" Name="kind_name" NumberOfTuples="1" format="ascii">)"
      R"(116 114 117 116 104 0</DataArray></CellData>)"));
  EXPECT_TRUE(file.region.empty());
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_TRUE(contains(file.warnings[0], "no line is of the kind \"estimate\", only of \"truth\""))
      << file.warnings[0];
}

TEST(ReadBoundary, TellsHowManyPointsLayOffTheTissue) {
  const BoundaryFile file =
      read(line_through("0.005 0.005 0 0.015 0.005 0.001 0.015 0.015 -0.002 0.005 0.015 0"));
  EXPECT_NEAR(file.region.area(), 1e-4, 1e-18);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_TRUE(
      contains(file.warnings[0],
               "b.vtp: 2 of 4 points of the boundary lay off the surface, by up to 0.002 m"))
      << file.warnings[0];
}

TEST(ReadBoundary, NamesThePointThatIsNotOnTheTissue) {
  const auto error_of = [](const std::string& text) { return io_error_of([&] { read(text); }); };
  const std::string far = error_of(line_through("5 5 0 15 5 0 15 15 0 5 15 0"));
  EXPECT_TRUE(contains(far, "b.vtp: point 0 of the boundary: the position (5, 5, 0) m is")) << far;
  EXPECT_TRUE(contains(far, "is it in millimetres?")) << far;
  const std::string above =
      error_of(line_through("0.005 0.005 0 0.015 0.005 0 0.015 0.015 0.006 0.005 0.015 0"));
  EXPECT_TRUE(contains(
      above, "b.vtp: point 2 of the boundary: the position (0.015, 0.015, 0.006) m is 0.006 m"))
      << above;
  for (const char* bad : {"nan", "inf", "1e999"}) {
    const std::string words = error_of(
        line_through(std::string("0.005 0.005 0 0.015 0.005 0 0.015 0.015 0 0.005 0.015 ") + bad));
    EXPECT_TRUE(contains(words, "b.vtp")) << words;
  }
  EXPECT_FALSE(
      error_of(line_through("1e300 0 0 0.015 0.005 0 0.015 0.015 0 0.005 0.015 0")).empty());
}

TEST(ReadBoundary, RefusesFilesThatAreNone) {
  const auto error_of = [](const std::string& text) { return io_error_of([&] { read(text); }); };
  for (const char* text : {"", "POLYGON EMPTY", "<VTKFile type=\"PolyData\">", "{}"})
    EXPECT_TRUE(contains(error_of(text), "b.vtp")) << text;
}

}  // namespace
}  // namespace palpation
