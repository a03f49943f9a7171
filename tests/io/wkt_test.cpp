#include "palpation/io/wkt.h"

#include <gtest/gtest.h>

#include "io/temporary_folder.h"

namespace palpation {
namespace {

Region region_of(const std::string& text) {
  const TemporaryFolder folder;
  return read_wkt(folder.file("a.wkt", text));
}

std::string error_of(const std::string& text) {
  return io_error_of([&] { region_of(text); });
}

TEST(ReadWkt, ReadsAPolygonWithAHole) {
  const Region region = region_of("POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 1 2, 2 2, 2 1, 1 1))\n");
  EXPECT_EQ(region.area(), 15.0);  // 16 - 1: whole numbers, exact
  EXPECT_FALSE(region.contains(Vec2(1.5, 1.5)));
}

TEST(ReadWkt, ReadsSeveralPolygonsInAnyCaseAndSpacing) {
  const Region region = region_of(" multipolygon(((0 0,1 0,1 1,0 1,0 0)),\r\n((2 0, 3 0, 3 2, 2 2, 2 0)))");
  EXPECT_EQ(region.area(), 3.0);
  EXPECT_EQ(region.polygons().size(), 2u);
}

TEST(ReadWkt, ReadsNothing) {
  EXPECT_TRUE(region_of("MULTIPOLYGON EMPTY").empty());
  EXPECT_TRUE(region_of("POLYGON EMPTY").empty());
}

TEST(ToWkt, ComesBackBitForBit) {
  const TemporaryFolder folder;
  const std::vector<PolygonWithHoles> polygons = {{{{0.1, 0.2}, {1.0 / 3.0, 0.2}, {0.3, 1e-17}}, {}},
                                                  {{{2, 2}, {5, 2}, {5, 5}, {2, 5}}, {{{3, 3}, {3, 4}, {4, 4}}}}};
  const Region region(polygons);
  const std::string text = to_wkt(region);
  EXPECT_EQ(to_wkt(read_wkt(folder.file("a.wkt", text))), text);
  EXPECT_EQ(to_wkt(Region()), "MULTIPOLYGON EMPTY");
}

TEST(ReadWkt, NamesTheByteAtFault) {
  EXPECT_TRUE(contains(error_of("POINT (0 0)"), "byte 0: POLYGON or MULTIPOLYGON"));
  EXPECT_TRUE(contains(error_of("POLYGON ((0 0, 1 0, 1 1, 0 0)) x"), "byte 31: text behind"));
  EXPECT_TRUE(contains(error_of("POLYGON ((0 0, 1 0, 1 1, 0 1))"), "byte 9: the ring does not end"));
  EXPECT_TRUE(contains(error_of("POLYGON ((0 0, 1 0, 0 0))"), "byte 9: a ring of 3 points"));
  EXPECT_TRUE(contains(error_of("POLYGON ((0 0, 1,0 0, 1 1, 0 0))"), "byte 16: \"\" is not a number"));
  EXPECT_TRUE(contains(error_of("POLYGON ((0 0, nan 0, 1 1, 0 0))"), "byte 15: \"nan\" is not finite"));
  EXPECT_TRUE(contains(error_of("POLYGON Z ((0 0 0))"), "only two coordinates"));
  EXPECT_TRUE(contains(error_of("POLYGON " + std::string(100000, '(')), "byte 10"));
}

TEST(ReadWkt, RefusesEveryTruncation) {
  const std::string whole = "MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)))";
  for (std::size_t length = 0; length < whole.size(); ++length) EXPECT_FALSE(error_of(whole.substr(0, length)).empty()) << length;
}

}  // namespace
}  // namespace palpation
