#include "palpation/io/read_boundary.h"

#include <gtest/gtest.h>

#include <string>

#include "io/square.h"
#include "io/temporary_folder.h"

namespace palpation {
namespace {

/// One closed line through four points.
std::string line_through(const std::string& points) {
  return R"(<VTKFile type="PolyData" version="1.0"><PolyData><Piece NumberOfPoints="4" NumberOfVerts="0" NumberOfLines="1" NumberOfStrips="0" )"
         R"(NumberOfPolys="0"><Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">)" +
         points +
         R"(</DataArray></Points><Lines><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3 0</DataArray>)"
         R"(<DataArray type="Int64" Name="offsets" format="ascii">5</DataArray></Lines></Piece></PolyData></VTKFile>)";
}

BoundaryFile read(const std::string& text) {
  const TemporaryFolder folder;
  return read_boundary_vtp(folder.file("b.vtp", text), square());
}

TEST(ReadBoundary, ReadsALineOnTheTissue) {
  const BoundaryFile file = read(line_through("0.005 0.005 0 0.015 0.005 0 0.015 0.015 0 0.005 0.015 0"));
  EXPECT_NEAR(file.region.area(), 1e-4, 1e-18);  // 1 x 1 cm, to a rounding
  EXPECT_TRUE(file.warnings.empty());
}

TEST(ReadBoundary, TellsHowManyPointsLayOffTheTissue) {
  const BoundaryFile file = read(line_through("0.005 0.005 0 0.015 0.005 0.001 0.015 0.015 -0.002 0.005 0.015 0"));
  EXPECT_NEAR(file.region.area(), 1e-4, 1e-18);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_TRUE(contains(file.warnings[0], "b.vtp: 2 of 5 points of the boundary lay off the surface, by up to 0.002 m")) << file.warnings[0];
}

TEST(ReadBoundary, NamesThePointThatIsNotOnTheTissue) {
  const auto error_of = [](const std::string& text) { return io_error_of([&] { read(text); }); };
  const std::string far = error_of(line_through("5 5 0 15 5 0 15 15 0 5 15 0"));
  EXPECT_TRUE(contains(far, "b.vtp: point 0 of the boundary: the position (5, 5, 0) m is")) << far;
  EXPECT_TRUE(contains(far, "is it in millimetres?")) << far;
  const std::string above = error_of(line_through("0.005 0.005 0 0.015 0.005 0 0.015 0.015 0.006 0.005 0.015 0"));
  EXPECT_TRUE(contains(above, "b.vtp: point 2 of the boundary: the position (0.015, 0.015, 0.006) m is 0.006 m")) << above;
  for (const char* bad : {"nan", "inf", "1e999"}) {
    const std::string words = error_of(line_through(std::string("0.005 0.005 0 0.015 0.005 0 0.015 0.015 0 0.005 0.015 ") + bad));
    EXPECT_TRUE(contains(words, "b.vtp")) << words;
  }
  EXPECT_FALSE(error_of(line_through("1e300 0 0 0.015 0.005 0 0.015 0.015 0 0.005 0.015 0")).empty());
}

TEST(ReadBoundary, RefusesFilesThatAreNone) {
  const auto error_of = [](const std::string& text) { return io_error_of([&] { read(text); }); };
  for (const char* text : {"", "POLYGON EMPTY", "<VTKFile type=\"PolyData\">", "{}"})
    EXPECT_TRUE(contains(error_of(text), "b.vtp")) << text;
}

}  // namespace
}  // namespace palpation
