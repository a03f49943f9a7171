#include "palpation/io/wkt.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "io/temporary_folder.h"

namespace palpation {
namespace {

Region region_of(const std::string& text) {
  const TemporaryFolder folder;
  return read_wkt(folder.file("a.wkt", text)).region;
}

std::string error_of(const std::string& text) {
  return io_error_of([&] { region_of(text); });
}

TEST(ReadWkt, ReadsAPolygonWithAHole) {
  const Region region =
      region_of("POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 1 2, 2 2, 2 1, 1 1))\n");
  EXPECT_EQ(region.area(), 15.0);  // 16 - 1: whole numbers, exact
  EXPECT_FALSE(region.contains(Vec2(1.5, 1.5)));
}

TEST(ReadWkt, ReadsSeveralPolygonsInAnyCaseAndSpacing) {
  const Region region =
      region_of(" multipolygon(((0 0,1 0,1 1,0 1,0 0)),\r\n((2 0, 3 0, 3 2, 2 2, 2 0)))");
  EXPECT_EQ(region.area(), 3.0);
  EXPECT_EQ(region.polygons().size(), 2u);
}

TEST(ParseWkt, ReadsTextAsItsFileWouldBeReadAndNamesIt) {
  EXPECT_EQ(parse_wkt("POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))", "clipboard").region.area(), 1.0);
  EXPECT_EQ(io_error_of([] { parse_wkt("POINT (1 2)", "clipboard"); }).find("clipboard, byte 0: "),
            0u);
}

TEST(ReadWkt, ReadsNothing) {
  EXPECT_TRUE(region_of("MULTIPOLYGON EMPTY").empty());
  EXPECT_TRUE(region_of("POLYGON EMPTY").empty());
}

TEST(ToWkt, ComesBackBitForBit) {
  const TemporaryFolder folder;
  const std::vector<PolygonWithHoles> polygons = {
      {{{0.1, 0.2}, {1.0 / 3.0, 0.2}, {0.3, 1e-17}}, {}},
      {{{2, 2}, {5, 2}, {5, 5}, {2, 5}}, {{{3, 3}, {3, 4}, {4, 4}}}}};
  const Region region(polygons);
  const std::string text = to_wkt(region);
  EXPECT_EQ(to_wkt(read_wkt(folder.file("a.wkt", text)).region), text);
  EXPECT_EQ(to_wkt(Region()), "MULTIPOLYGON EMPTY");
}

TEST(ReadWkt, NamesTheByteAtFault) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "byte 0: POLYGON or MULTIPOLYGON is expected, not the end of the file"},
      {" \n", "byte 2: POLYGON or MULTIPOLYGON is expected, not the end of the file"},
      {"POINT (0 0)", "byte 0: POLYGON or MULTIPOLYGON is expected, not \"POINT\""},
      {"LINESTRING (0 0, 1 1)", "not \"LINESTRING\""},
      {"GEOMETRYCOLLECTION (POLYGON ((0 0, 1 0, 1 1, 0 0)))", "not \"GEOMETRYCOLLECTION\""},
      {"SRID=4326;POLYGON ((0 0, 1 0, 1 1, 0 0))", "not \"SRID\""},
      {"MULTIPOLYGON ()", "byte 14: \"(\" is expected, not \")\""},
      {"POLYGON ((0 0, 1 0, 1 1, 0 0)) x", "byte 31: there is text behind the geometry: \"x\""},
      {"POLYGON ((0 0, 1 0, 1 1, 0 1))", "byte 9: the ring does not end"},
      {"POLYGON ((0 0, 1 0, 0 0))", "byte 9: a ring of 3 points"},
      {"POLYGON ((0 0, 1,0 0, 1 1, 0 0))", "byte 16: a number is expected, not \",0 0"},
      {"POLYGON ((0 0, nan 0, 1 1, 0 0))", "byte 15: \"nan\" is not finite"},
      {"POLYGON ((0 0, -inf 0, 1 1, 0 0))", "byte 15: \"-inf\" is not finite"},
      {"POLYGON ((0 0, 1e999 0, 1 1, 0 0))", "byte 15: \"1e999\" is not finite"},
      {"POLYGON ((0 0, 1e300 0, 1 1, 0 0))",
       "byte 15: \"1e300\" is more than 1e9 m from the origin"},
      {"POLYGON ((0 0, 0x1 0, 1 1, 0 0))", "byte 15: \"0x1\" is not a number"},
      {"POLYGON Z ((0 0 0))",
       "byte 9: EMPTY or \"(\" is expected, not \"Z\": points have two coordinates"},
      {"POLYGON ((0 0 0, 1 0 0, 1 1 0, 0 0 0))",
       "byte 14: \",\" or \")\" is expected behind a point of two coordinates"},
      {"POLYGON ((0 0, 1 1, 1 0, 0 1, 0 0))", "byte 8: the outer ring must not cross itself"},
      {"MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)), ((2 0, 3 1, 3 0, 2 1, 2 0)))",
       "byte 38: the outer ring must not cross itself"},
      {"POLYGON ((0 0, 9 0, 9 9, 0 0), (20 20, 21 20, 21 21, 20 20))",
       "byte 8: hole 0 must be inside its outer ring"},
      {"POLYGON ((0 0, 1 0, 2 0, 0 0))", "byte 8: no area is inside"},
      {"POLYGON ((1 1, 1 1, 1 1, 1 1))", "byte 8: no area is inside"},
      {"POLYGON " + std::string(1000000, '('), "byte 10: a number is expected, not \"(("},
      {std::string("POLYGON ((0 0, 1 0, 1 1, 0 0))\0", 31), "byte 30: there is text behind"},
  };
  for (const auto& [text, words] : cases)
    EXPECT_TRUE(contains(error_of(text), words)) << error_of(text) << "\nlacks: " << words;
}

TEST(ReadWkt, UnitesPolygonsThatOverlap) {
  // Two squares of 2 x 2 that share one of 1 x 1.
  EXPECT_EQ(
      region_of("MULTIPOLYGON (((0 0, 2 0, 2 2, 0 2, 0 0)), ((1 1, 3 1, 3 3, 1 3, 1 1)))").area(),
      7.0);
}

TEST(ReadWkt, ReadsEitherOrientationRepeatsAndAByteOrderMark) {
  for (const char* text :
       {"POLYGON ((0 0, 0 2, 2 2, 2 0, 0 0))", "POLYGON ((0 0, 2 0, 2 0, 2 2, 0 2, 0 0, 0 0))",
        "\xEF\xBB\xBFPOLYGON ((0 0, 2 0, 3 0, 2 0, 2 2, 0 2, 0 0))"}) {
    EXPECT_EQ(region_of(text).area(), 4.0) << text;
  }
}

TEST(ReadWkt, TellsWhatWasTidiedAway) {
  const TemporaryFolder folder;
  EXPECT_TRUE(
      read_wkt(folder.file("a.wkt", "POLYGON ((0 0, 2 0, 2 2, 0 2, 0 0))")).warnings.empty());
  const BoundaryFile spiky =
      read_wkt(folder.file("a.wkt", "POLYGON ((0 0, 2 0, 2 0, 3 0, 2 0, 2 2, 0 2, 0 0))"));
  EXPECT_EQ(spiky.region.area(), 4.0);
  ASSERT_EQ(spiky.warnings.size(), 2u);
  for (const std::string& warning : spiky.warnings)
    EXPECT_TRUE(contains(warning, "a.wkt: ")) << warning;
}

TEST(ReadWkt, ReadsAHundredThousandCornersInTime) {
  std::string text = "POLYGON ((";
  constexpr int kCorners = 100000;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i % kCorners) / kCorners;
    text += (i > 0 ? ", " : "") + text_of(std::cos(angle)) + " " + text_of(std::sin(angle));
  }
  EXPECT_NEAR(region_of(text + "))").area(), std::numbers::pi,
              1e-8);  // short of the disk by pi (2 pi / n)^2 / 6
}

TEST(ReadWkt, RefusesEveryTruncation) {
  const std::string whole = "MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)))";
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_FALSE(error_of(whole.substr(0, length)).empty()) << length;
}

}  // namespace
}  // namespace palpation
