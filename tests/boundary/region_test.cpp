#include "palpation/boundary/region.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>

#include "palpation/base/error.h"
#include "palpation/base/random.h"

namespace palpation {
namespace {

Ring box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

Region region_of(Ring outer, std::vector<Ring> holes = {}) {
  const std::array polygon{PolygonWithHoles{std::move(outer), std::move(holes)}};
  return Region(polygon);
}

Region even_odd(const std::vector<Ring>& rings) { return Region::even_odd(rings); }

Ring reversed(Ring ring) { return {ring.rbegin(), ring.rend()}; }

bool same(const Region& a, const Region& b) { return symmetric_difference(a, b).empty(); }

/// What is thrown as InvalidInput, or nothing.
template <typename Work>
std::string refusal(Work work) {
  try {
    work();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Corners on a coarse lattice: edges overlap, corners coincide and points repeat all the time.
Ring lattice_ring(Random& random, int corners, int side) {
  Ring ring;
  for (int i = 0; i < corners; ++i) ring.emplace_back(random.below(side), random.below(side));
  return ring;
}

Ring star(Random& random, const Vec2& centre, double radius, int corners) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.8 * random.uniform()) / corners;
    ring.push_back(centre + radius * (0.4 + 0.6 * random.uniform()) * Vec2(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

TEST(Region, OfNothingIsEmptyAndHasNoArea) {
  EXPECT_TRUE(Region().empty());
  EXPECT_EQ(Region().area(), 0.0);
  EXPECT_TRUE(Region().polygons().empty());
  EXPECT_FALSE(Region().contains({0.0, 0.0}));
  EXPECT_TRUE(Region(std::span<const PolygonWithHoles>()).empty());
  EXPECT_TRUE(even_odd({}).empty());
}

TEST(Region, ReadsRingsEitherWayRound) {
  const Region forwards = region_of(box(0, 0, 3, 3), {box(1, 1, 2, 2)});
  const Region backwards = region_of(reversed(box(0, 0, 3, 3)), {reversed(box(1, 1, 2, 2))});
  EXPECT_EQ(forwards.area(), 8.0);
  EXPECT_EQ(backwards.area(), 8.0);
  EXPECT_TRUE(same(forwards, backwards));
}

TEST(Region, ListsOuterRingsCounterClockwiseAndHolesClockwiseFromTheirLowestCorner) {
  const Region region = region_of(reversed(box(0, 0, 3, 3)), {box(1, 1, 2, 2)});
  ASSERT_EQ(region.polygons().size(), 1u);
  EXPECT_EQ(region.polygons()[0].outer, box(0, 0, 3, 3));
  ASSERT_EQ(region.polygons()[0].holes.size(), 1u);
  EXPECT_EQ(region.polygons()[0].holes[0], (Ring{{1, 1}, {1, 2}, {2, 2}, {2, 1}}));
}

TEST(Region, ListsPolygonsByFallingAreaThenLowestCorner) {
  const Region region = even_odd({box(4, 0, 5, 1), box(0, 0, 1, 1), box(8, 0, 10, 2), box(0, 2, 1, 3)});
  const auto polygons = region.polygons();
  ASSERT_EQ(polygons.size(), 4u);
  EXPECT_EQ(polygons[0].outer.front(), Vec2(8, 0));
  EXPECT_EQ(polygons[1].outer.front(), Vec2(0, 0));
  EXPECT_EQ(polygons[2].outer.front(), Vec2(0, 2));
  EXPECT_EQ(polygons[3].outer.front(), Vec2(4, 0));
}

TEST(Region, DropsRepeatedPointsSpikesAndStraightCorners) {
  const Ring untidy{{0, 0}, {0, 0}, {1, 0}, {2, 0}, {2, 0}, {2, 2}, {2, 5}, {2, 2}, {0, 2}, {-7, 2}, {-3, 2}, {0, 2}, {0, 0}, {0, 0}};
  const Region region = region_of(untidy);
  ASSERT_EQ(region.polygons().size(), 1u);
  EXPECT_EQ(region.polygons()[0].outer, box(0, 0, 2, 2));
}

TEST(Region, DropsASpikeWhereTheRingStarts) {
  EXPECT_TRUE(same(region_of({{5, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}, {2, 0}}), region_of(box(0, 0, 2, 2))));
  EXPECT_TRUE(same(region_of({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}, {0, -4}}), region_of(box(0, 0, 2, 2))));
}

TEST(Region, DropsWhatHasNoArea) {
  EXPECT_TRUE(region_of({}).empty());
  EXPECT_TRUE(region_of({{1, 1}}).empty());
  EXPECT_TRUE(region_of({{1, 1}, {2, 2}}).empty());
  EXPECT_TRUE(region_of({{1, 1}, {1, 1}, {1, 1}, {1, 1}}).empty());
  EXPECT_TRUE(region_of({{0, 0}, {1, 1}, {3, 3}, {2, 2}}).empty());
  EXPECT_EQ(region_of(box(0, 0, 3, 3), {{{1, 1}, {2, 2}}}).area(), 9.0);
}

TEST(Region, RefusesABowTieAndSaysWhereItCrosses) {
  const std::string message = refusal([] { region_of({{0, 0}, {2, 2}, {2, 0}, {0, 2}}); });
  EXPECT_TRUE(contains(message, "must not cross itself")) << message;
  EXPECT_TRUE(contains(message, "(1 1)")) << message;
}

TEST(Region, RefusesARingThatRunsRoundTwice) {
  EXPECT_TRUE(contains(refusal([] {
                         region_of({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {3, 1}, {3, 3}, {-1, 3}});
                       }),
                       "must not cross itself"));
}

TEST(Region, RefusesARingThatTouchesItselfAlongALine) {
  // Two squares joined by a bridge of no width, once there and once back.
  const Ring dumbbell{{0, 0}, {1, 0}, {1, 1}, {3, 1}, {3, 0}, {4, 0}, {4, 2}, {3, 2}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};
  EXPECT_TRUE(contains(refusal([&] { region_of(dumbbell); }), "must not touch itself along a line"));
}

TEST(Region, CutsARingThatTouchesItselfAtAPoint) {
  const Region two_squares = region_of({{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 1}, {0, 1}});
  EXPECT_EQ(two_squares.area(), 2.0);
  EXPECT_EQ(two_squares.polygons().size(), 2u);
  // An outline that reaches its own hole at one corner.
  const Region pinched = region_of({{0, 0}, {4, 0}, {4, 4}, {2, 4}, {3, 2}, {1, 2}, {2, 4}, {0, 4}});
  EXPECT_EQ(pinched.area(), 14.0);
  ASSERT_EQ(pinched.polygons().size(), 1u);
  EXPECT_EQ(pinched.polygons()[0].holes.size(), 1u);
}

TEST(Region, RefusesHolesOutsideTheirOuterRingOrOverEachOther) {
  EXPECT_TRUE(contains(refusal([] { region_of(box(0, 0, 3, 3), {box(5, 5, 6, 6)}); }), "must be inside its outer ring"));
  EXPECT_TRUE(contains(refusal([] { region_of(box(0, 0, 3, 3), {box(2, 2, 4, 4)}); }), "must be inside its outer ring"));
  EXPECT_TRUE(contains(refusal([] { region_of(box(0, 0, 9, 9), {box(1, 1, 4, 4), box(3, 3, 6, 6)}); }), "must not overlap"));
  EXPECT_TRUE(contains(refusal([] { region_of({}, {box(1, 1, 4, 4)}); }), "must be inside its outer ring"));
}

TEST(Region, AcceptsHolesThatTouch) {
  EXPECT_EQ(region_of(box(0, 0, 9, 9), {box(1, 1, 4, 4), box(4, 4, 6, 6)}).area(), 81.0 - 9.0 - 4.0);
  EXPECT_EQ(region_of(box(0, 0, 9, 9), {box(1, 1, 4, 4), box(4, 1, 6, 4)}).area(), 81.0 - 9.0 - 6.0);
  EXPECT_EQ(region_of(box(0, 0, 4, 4), {{{0, 0}, {2, 1}, {1, 2}}}).area(), 16.0 - 1.5);
  EXPECT_EQ(region_of(box(0, 0, 4, 4), {box(0, 0, 1, 1)}).area(), 15.0);
  EXPECT_TRUE(region_of(box(0, 0, 4, 4), {box(0, 0, 4, 4)}).empty());
}

TEST(Region, IsTheUnionOfItsPolygons) {
  const std::vector<PolygonWithHoles> polygons{{box(0, 0, 4, 4), {box(1, 1, 3, 3)}}, {box(2, 2, 6, 6), {}}, {box(5, 5, 6, 6), {}}};
  EXPECT_EQ(Region(polygons).area(), 16.0 - 4.0 + 16.0 - 4.0 + 1.0);
}

TEST(Region, RefusesCoordinatesThatAreNotFiniteOrTooLarge) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity}) {
    EXPECT_TRUE(contains(refusal([&] { region_of({{0, 0}, {1, bad}, {1, 1}}); }), "must be finite"));
    EXPECT_TRUE(contains(refusal([&] { even_odd({{{0, 0}, {bad, 1}, {1, 1}}}); }), "must be finite"));
    EXPECT_TRUE(contains(refusal([&] { static_cast<void>(Region().contains({bad, 0})); }), "must be finite"));
  }
  EXPECT_TRUE(contains(refusal([] { region_of({{0, 0}, {1e300, 0}, {1, 1}}); }), "within 1e9 m"));
  EXPECT_EQ(region_of(box(-1e9, -1e9, 1e9, 1e9)).area(), 4e18);
}

TEST(Region, IsExactAtExtremeScales) {
  // 2^-300: far below what any filter of floating-point errors copes with. The true area is 2^-600.
  const double tiny = std::ldexp(1.0, -300);
  EXPECT_EQ(region_of(box(0, 0, tiny, tiny)).area(), std::ldexp(1.0, -600));
  // A sliver one unit in the last place wide, beside 1.
  const double next = std::nextafter(1.0, 2.0);
  const Region sliver = subtract(region_of(box(0, 0, next, 1)), region_of(box(0, 0, 1, 1)));
  EXPECT_EQ(sliver.area(), next - 1.0);
}

TEST(EvenOdd, TakesABowTieForTwoTriangles) {
  const Region region = even_odd({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}});
  EXPECT_EQ(region.area(), 2.0);
  EXPECT_EQ(region.polygons().size(), 2u);
}

TEST(EvenOdd, AlternatesBetweenNestedRingsWhicheverWayTheyRun) {
  EXPECT_EQ(even_odd({box(0, 0, 9, 9), box(1, 1, 8, 8), reversed(box(2, 2, 7, 7)), box(3, 3, 6, 6)}).area(), 81.0 - 49.0 + 25.0 - 9.0);
  EXPECT_TRUE(even_odd({box(0, 0, 9, 9), reversed(box(0, 0, 9, 9))}).empty());
  EXPECT_EQ(even_odd({box(0, 0, 9, 9), box(0, 0, 9, 9), box(0, 0, 9, 9)}).area(), 81.0);
}

TEST(EvenOdd, IgnoresSpikesRepeatsAndWhatHasNoArea) {
  const std::vector<Ring> rings{
      {{0, 0}, {2, 0}, {2, 0}, {2, 2}, {2, 7}, {2, 2}, {0, 2}, {0, 0}}, {}, {{5, 5}}, {{5, 5}, {6, 6}}, {{0, 0}, {1, 1}, {5, 5}}};
  EXPECT_TRUE(same(even_odd(rings), region_of(box(0, 0, 2, 2))));
}

TEST(EvenOdd, IsTheSymmetricDifferenceOfItsRings) {
  Random random(5);
  for (int trial = 0; trial < 60; ++trial) {
    const std::vector<Ring> rings{lattice_ring(random, 7, 6), lattice_ring(random, 5, 6), lattice_ring(random, 6, 6)};
    const Region one_by_one = symmetric_difference(symmetric_difference(even_odd({rings[0]}), even_odd({rings[1]})), even_odd({rings[2]}));
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

TEST(Booleans, OfBoxesThatTouchKeepNoSeamAndNoSliver) {
  const Region left = region_of(box(0, 0, 2, 2));
  const Region right = region_of(box(2, 0, 4, 2));
  ASSERT_EQ(unite(left, right).polygons().size(), 1u);
  EXPECT_EQ(unite(left, right).polygons()[0].outer, box(0, 0, 4, 2));
  EXPECT_TRUE(intersect(left, right).empty());
  EXPECT_TRUE(intersect(left, region_of(box(2, 2, 3, 3))).empty());
  EXPECT_EQ(unite(left, region_of(box(2, 2, 3, 3))).polygons().size(), 2u);
}

TEST(Booleans, WithNothingAndWithItself) {
  const Region a = region_of(box(0, 0, 4, 4), {box(1, 1, 2, 2)});
  EXPECT_TRUE(symmetric_difference(a, a).empty());
  EXPECT_TRUE(subtract(a, a).empty());
  EXPECT_TRUE(same(unite(a, a), a));
  EXPECT_TRUE(same(intersect(a, a), a));
  EXPECT_TRUE(same(unite(a, Region()), a));
  EXPECT_TRUE(same(subtract(a, Region()), a));
  EXPECT_TRUE(intersect(a, Region()).empty());
  EXPECT_TRUE(unite(Region(), Region()).empty());
}

// The identities of areas, in exact arithmetic: two sides are equal exactly when the symmetric difference of the regions is empty.
TEST(Booleans, KeepTheIdentitiesExactlyOnDegenerateInput) {
  Random random(11);
  for (int trial = 0; trial < 150; ++trial) {
    const Region a = even_odd({lattice_ring(random, 3 + random.below(6), 7), lattice_ring(random, 4, 7)});
    const Region b = even_odd({lattice_ring(random, 3 + random.below(6), 7), lattice_ring(random, 4, 7)});
    const Region both = intersect(a, b);
    const Region difference = symmetric_difference(a, b);
    EXPECT_TRUE(same(difference, unite(subtract(a, b), subtract(b, a)))) << "trial " << trial;
    EXPECT_TRUE(same(difference, subtract(unite(a, b), both))) << "trial " << trial;
    EXPECT_TRUE(same(a, unite(subtract(a, b), both))) << "trial " << trial;
    EXPECT_TRUE(intersect(subtract(a, b), b).empty()) << "trial " << trial;
    EXPECT_TRUE(same(symmetric_difference(difference, b), a)) << "trial " << trial;
    // On so small a lattice the areas are around 10 and rounded once each: 1e-13 is a hundred times their rounding.
    EXPECT_NEAR(difference.area(), a.area() + b.area() - 2.0 * both.area(), 1e-13) << "trial " << trial;
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
    // Crossings are rational, so the rounded rings differ from the exact ones by about 1e-15 along a boundary shorter than 100.
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
  for (const Vec2& on_border : {Vec2(0, 0), Vec2(4, 2), Vec2(2, 4), Vec2(1, 1), Vec2(3, 2), Vec2(2, 3), Vec2(4, 0)}) {
    EXPECT_TRUE(region.contains(on_border)) << on_border.transpose();
  }
  EXPECT_FALSE(region.contains({std::nextafter(1.0, 2.0), 2.0}));
  EXPECT_FALSE(region.contains({std::nextafter(4.0, 5.0), 2.0}));
}

TEST(Region, ContainsWhatItsAreaCounts) {
  Random random(15);
  const Region region = region_of(star(random, {0.5, 0.5}, 0.5, 40), {star(random, {0.5, 0.5}, 0.1, 9)});
  const int samples = 40'000;
  int inside = 0;
  for (int i = 0; i < samples; ++i) inside += region.contains({random.uniform(), random.uniform()}) ? 1 : 0;
  // Five standard errors of the fraction.
  EXPECT_NEAR(static_cast<double>(inside) / samples, region.area(), 5.0 * 0.5 / std::sqrt(samples));
}

TEST(Region, RefusesOutlinesWithMillionsOfCrossingsBeforePayingForThem) {
  // Two combs of 1,500 teeth, at right angles: 9 million crossings.
  Ring teeth;
  Ring turned;
  for (int i = 0; i < 1500; ++i) {
    for (const Vec2& corner : {Vec2(2 * i, 0), Vec2(2 * i + 1, 3000), Vec2(2 * i + 2, 0)}) {
      teeth.push_back(corner);
      turned.emplace_back(corner.y() + 0.25, corner.x() + 0.5);
    }
  }
  const Region a = even_odd({teeth});
  const Region b = even_odd({turned});
  EXPECT_TRUE(contains(refusal([&] { intersect(a, b); }), "may cross at most"));
}

TEST(Region, OfTwentyThousandCornersTakesNoStack) {
  Random random(16);
  Region ring = region_of(star(random, {0, 0}, 1.0, 20'000));
  EXPECT_FALSE(ring.empty());
  ring = Region();
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
  while (std::getline(file, line_a) && std::getline(file, line_b) && std::getline(file, line_areas)) {
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
    EXPECT_NEAR(overlap_areas(a, b).only_a_m2 + overlap_areas(a, b).only_b_m2, difference, tolerance) << "pair " << pairs;
    ++pairs;
  }
  EXPECT_EQ(pairs, 1000);
}

}  // namespace
}  // namespace palpation
