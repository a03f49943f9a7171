#include "palpation/boundary/region.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>

#include "boundary/polygons.h"

namespace palpation {
namespace {

using testing::box;
using testing::even_odd;
using testing::lattice_ring;
using testing::region_of;
using testing::reversed;
using testing::same;
using testing::star;

TEST(Region, OfNothingIsEmptyAndHasNoArea) {
  EXPECT_TRUE(Region().empty());
  EXPECT_EQ(Region().area(), 0.0);
  EXPECT_TRUE(Region().polygons().empty());
  EXPECT_FALSE(Region().contains({0.0, 0.0}));
  EXPECT_TRUE(Region(std::span<const PolygonWithHoles>()).empty());
  EXPECT_TRUE(even_odd({}).empty());
}

TEST(Region, ListsOuterRingsCounterClockwiseAndHolesClockwiseFromTheirLowestCorner) {
  const Region region = region_of(reversed(box(0, 0, 3, 3)), {box(1, 1, 2, 2)});
  ASSERT_EQ(region.polygons().size(), 1u);
  EXPECT_EQ(region.polygons()[0].outer, box(0, 0, 3, 3));
  ASSERT_EQ(region.polygons()[0].holes.size(), 1u);
  EXPECT_EQ(region.polygons()[0].holes[0], (Ring{{1, 1}, {1, 2}, {2, 2}, {2, 1}}));
}

TEST(Region, ListsPolygonsByFallingAreaThenLowestCorner) {
  const Region region =
      even_odd({box(4, 0, 5, 1), box(0, 0, 1, 1), box(8, 0, 10, 2), box(0, 2, 1, 3)});
  const auto polygons = region.polygons();
  ASSERT_EQ(polygons.size(), 4u);
  EXPECT_EQ(polygons[0].outer.front(), Vec2(8, 0));
  EXPECT_EQ(polygons[1].outer.front(), Vec2(0, 0));
  EXPECT_EQ(polygons[2].outer.front(), Vec2(0, 2));
  EXPECT_EQ(polygons[3].outer.front(), Vec2(4, 0));
}

TEST(Region, IsTheUnionOfItsPolygons) {
  const std::vector<PolygonWithHoles> polygons{
      {box(0, 0, 4, 4), {box(1, 1, 3, 3)}}, {box(2, 2, 6, 6), {}}, {box(5, 5, 6, 6), {}}};
  EXPECT_EQ(Region(polygons).area(), 16.0 - 4.0 + 16.0 - 4.0 + 1.0);
}

TEST(Region, IsExactAtExtremeScales) {
  // 2^-300: far below what any filter of floating-point errors copes with. The true area is 2^-600.
  const double tiny = std::ldexp(1.0, -300);
  EXPECT_EQ(region_of(box(0, 0, tiny, tiny)).area(), std::ldexp(1.0, -600));
  // A sliver one unit in the last place wide, beside 1.
  const double next = std::nextafter(1.0, 2.0);
  const Region sliver = subtract(region_of(box(0, 0, next, 1)), region_of(box(0, 0, 1, 1)));
  EXPECT_EQ(sliver.area(), next - 1.0);
  // Slivers far thinner than a unit in the last place of their length.
  EXPECT_EQ(region_of({{0, 0}, {1, 0}, {1, std::ldexp(1.0, -400)}}).area(), std::ldexp(1.0, -401));
  EXPECT_EQ(region_of({{0, 0}, {1, 0}, {1, std::ldexp(1.0, -1000)}}).area(),
            std::ldexp(1.0, -1001));
  EXPECT_EQ(region_of({{-1e9, 0}, {1e9, 0}, {1e9, std::ldexp(1.0, -1070)}}).area(),
            std::ldexp(1e9, -1070));
}

TEST(Region, FarFromTheOriginIsAsExactAsNearIt) {
  // A square whose sides are one unit in the last place of 2^29, 1.2e-7 m.
  const double corner = std::ldexp(1.0, 29);
  const double side = std::ldexp(1.0, -23);
  const Region square = region_of(box(corner, corner, corner + side, corner + side));
  EXPECT_EQ(square.area(), side * side);
  const Region triangle =
      region_of({{corner, corner}, {corner + side, corner}, {corner + side, corner + side}});
  EXPECT_EQ(symmetric_difference(square, triangle).area(), 0.5 * side * side);
}

TEST(EvenOdd, AlternatesBetweenNestedRingsWhicheverWayTheyRun) {
  EXPECT_EQ(even_odd({box(0, 0, 9, 9), box(1, 1, 8, 8), reversed(box(2, 2, 7, 7)), box(3, 3, 6, 6)})
                .area(),
            81.0 - 49.0 + 25.0 - 9.0);
  EXPECT_TRUE(even_odd({box(0, 0, 9, 9), reversed(box(0, 0, 9, 9))}).empty());
  EXPECT_EQ(even_odd({box(0, 0, 9, 9), box(0, 0, 9, 9), box(0, 0, 9, 9)}).area(), 81.0);
}

TEST(EvenOdd, IgnoresSpikesRepeatsAndWhatHasNoArea) {
  const std::vector<Ring> rings{{{0, 0}, {2, 0}, {2, 0}, {2, 2}, {2, 7}, {2, 2}, {0, 2}, {0, 0}},
                                {},
                                {{5, 5}},
                                {{5, 5}, {6, 6}},
                                {{0, 0}, {1, 1}, {5, 5}}};
  EXPECT_TRUE(same(even_odd(rings), region_of(box(0, 0, 2, 2))));
}

TEST(EvenOdd, IsTheSymmetricDifferenceOfItsRings) {
  Random random(5);
  for (int trial = 0; trial < 60; ++trial) {
    const std::vector<Ring> rings{lattice_ring(random, 7, 6), lattice_ring(random, 5, 6),
                                  lattice_ring(random, 6, 6)};
    const Region one_by_one = symmetric_difference(
        symmetric_difference(even_odd({rings[0]}), even_odd({rings[1]})), even_odd({rings[2]}));
    EXPECT_TRUE(same(even_odd(rings), one_by_one)) << "trial " << trial;
  }
}

TEST(Booleans, OfTwoBoxesAreWhatOneCountsByHand) {
  const Region a = region_of(box(0, 0, 4, 4));
  const Region b = region_of(box(2, 2, 6, 6));
  EXPECT_EQ(unite(a, b).area(), 28.0);
  EXPECT_EQ(intersect(a, b).area(), 4.0);
  EXPECT_EQ(subtract(a, b).area(), 12.0);
  EXPECT_EQ(symmetric_difference(a, b).area(), 24.0);
  const OverlapAreas areas = overlap_areas(a, subtract(b, region_of(box(2, 2, 3, 3))));
  EXPECT_EQ(areas.both_m2, 3.0);
  EXPECT_EQ(areas.only_a_m2, 13.0);
  EXPECT_EQ(areas.only_b_m2, 12.0);
}

// The identities of areas, in exact arithmetic: two sides are equal exactly when the symmetric
// difference of the regions is empty.
TEST(Booleans, KeepTheIdentitiesExactlyOnDegenerateInput) {
  Random random(11);
  for (int trial = 0; trial < 150; ++trial) {
    const Region a =
        even_odd({lattice_ring(random, 3 + random.below(6), 7), lattice_ring(random, 4, 7)});
    const Region b =
        even_odd({lattice_ring(random, 3 + random.below(6), 7), lattice_ring(random, 4, 7)});
    const Region both = intersect(a, b);
    const Region difference = symmetric_difference(a, b);
    EXPECT_TRUE(same(difference, unite(subtract(a, b), subtract(b, a)))) << "trial " << trial;
    EXPECT_TRUE(same(difference, subtract(unite(a, b), both))) << "trial " << trial;
    EXPECT_TRUE(same(a, unite(subtract(a, b), both))) << "trial " << trial;
    EXPECT_TRUE(intersect(subtract(a, b), b).empty()) << "trial " << trial;
    EXPECT_TRUE(same(symmetric_difference(difference, b), a)) << "trial " << trial;
    // On so small a lattice the areas are around 10 and rounded once each: 1e-13 is a hundred times
    // their rounding.
    EXPECT_NEAR(difference.area(), a.area() + b.area() - 2.0 * both.area(), 1e-13)
        << "trial " << trial;
  }
}

TEST(Booleans, KeepTheIdentitiesExactlyOnRoughOutlines) {
  Random random(12);
  for (int trial = 0; trial < 20; ++trial) {
    const Region a = region_of(star(random, {0, 0}, 1.0, 90), {star(random, {0.1, 0}, 0.2, 20)});
    const Region b = region_of(star(random, {0.2, 0.1}, 1.0, 90));
    const Region difference = symmetric_difference(a, b);
    EXPECT_TRUE(same(difference, unite(subtract(a, b), subtract(b, a)))) << "trial " << trial;
    EXPECT_TRUE(same(a, unite(subtract(a, b), intersect(a, b)))) << "trial " << trial;
  }
}

TEST(Booleans, OfManyRegionsInTurnStayExact) {
  Random random(13);
  std::vector<Region> stars;
  for (int i = 0; i < 8; ++i) stars.push_back(region_of(star(random, {0.1 * i, 0.0}, 1.0, 12)));
  Region forwards;
  Region backwards;
  for (int i = 0; i < 8; ++i) {
    forwards = symmetric_difference(forwards, stars[i]);
    backwards = symmetric_difference(backwards, stars[7 - i]);
  }
  EXPECT_TRUE(same(forwards, backwards));
}

TEST(Region, ListsRingsThatMakeTheSameRegionAgain) {
  Random random(14);
  for (int trial = 0; trial < 100; ++trial) {
    const Region region = even_odd({lattice_ring(random, 9, 7), lattice_ring(random, 6, 7)});
    // Crossings are rational, so the rounded rings differ from the exact ones by about 1e-15 along
    // a boundary shorter than 100.
    const auto polygons = region.polygons();
    std::vector<Ring> rings;
    for (const PolygonWithHoles& polygon : polygons) {
      rings.push_back(polygon.outer);
      rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
    }
    EXPECT_LT(symmetric_difference(even_odd(rings), region).area(), 1e-12) << "trial " << trial;
  }
}

TEST(Region, ContainsItsBorderAndNotItsHoles) {
  const Region region = region_of(box(0, 0, 4, 4), {box(1, 1, 3, 3)});
  EXPECT_TRUE(region.contains({0.5, 2.0}));
  EXPECT_TRUE(region.contains({3.5, 1.0}));
  EXPECT_FALSE(region.contains({2.0, 2.0}));
  EXPECT_FALSE(region.contains({5.0, 4.0}));
  EXPECT_FALSE(region.contains({-1.0, 1.0}));
  for (const Vec2& on_border :
       {Vec2(0, 0), Vec2(4, 2), Vec2(2, 4), Vec2(1, 1), Vec2(3, 2), Vec2(2, 3), Vec2(4, 0)}) {
    EXPECT_TRUE(region.contains(on_border)) << on_border.transpose();
  }
  EXPECT_FALSE(region.contains({std::nextafter(1.0, 2.0), 2.0}));
  EXPECT_FALSE(region.contains({std::nextafter(4.0, 5.0), 2.0}));
}

TEST(Region, ContainsWhatItsAreaCounts) {
  Random random(15);
  const Region region =
      region_of(star(random, {0.5, 0.5}, 0.5, 40), {star(random, {0.5, 0.5}, 0.1, 9)});
  const int samples = 40'000;
  int inside = 0;
  for (int i = 0; i < samples; ++i)
    inside += region.contains({random.uniform(), random.uniform()}) ? 1 : 0;
  // Five standard errors of the fraction.
  EXPECT_NEAR(static_cast<double>(inside) / samples, region.area(), 5.0 * 0.5 / std::sqrt(samples));
}

Ring parse_ring(const std::string& text) {
  Ring ring;
  std::stringstream in(text);
  double x = 0.0;
  double y = 0.0;
  char comma = 0;
  while (in >> x >> comma >> y) {
    ring.emplace_back(x, y);
    in >> comma;
  }
  return ring;
}

Region parse_region(const std::string& line) {
  std::stringstream in(line.substr(2));
  std::string ring;
  PolygonWithHoles polygon;
  std::getline(in, ring, '|');
  polygon.outer = parse_ring(ring);
  while (std::getline(in, ring, '|')) polygon.holes.push_back(parse_ring(ring));
  const std::array one{polygon};
  return Region(one);
}

// 1,000 random pairs, holes included: make_shapely_reference.py wrote the file.
TEST(Booleans, AgreeWithShapelyOnAThousandPairs) {
  std::ifstream file(PALPATION_SOURCE_DIR "/tests/boundary/shapely_reference.txt");
  std::string line_a;
  std::string line_b;
  std::string line_areas;
  int pairs = 0;
  while (std::getline(file, line_a) && std::getline(file, line_b) &&
         std::getline(file, line_areas)) {
    const Region a = parse_region(line_a);
    const Region b = parse_region(line_b);
    std::stringstream areas(line_areas.substr(2));
    double of_a = 0.0, of_b = 0.0, both = 0.0, either = 0.0, difference = 0.0;
    areas >> of_a >> of_b >> both >> either >> difference;
    ASSERT_TRUE(areas) << "pair " << pairs;
    const double tolerance = 1e-12 * either;  // shapely itself is good to about 1e-15
    EXPECT_NEAR(a.area(), of_a, tolerance) << "pair " << pairs;
    EXPECT_NEAR(b.area(), of_b, tolerance) << "pair " << pairs;
    EXPECT_NEAR(intersect(a, b).area(), both, tolerance) << "pair " << pairs;
    EXPECT_NEAR(unite(a, b).area(), either, tolerance) << "pair " << pairs;
    EXPECT_NEAR(symmetric_difference(a, b).area(), difference, tolerance) << "pair " << pairs;
    EXPECT_NEAR(overlap_areas(a, b).only_a_m2 + overlap_areas(a, b).only_b_m2, difference,
                tolerance)
        << "pair " << pairs;
    ++pairs;
  }
  EXPECT_EQ(pairs, 1000);
}

}  // namespace
}  // namespace palpation
