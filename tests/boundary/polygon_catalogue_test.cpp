// What a polygon may look like that a person or a program hands over, row by row of the catalogue
// of polygons: P01 to P16. P15 (an outline in the chart of another tissue) is a matter of the tool,
// which reads outlines and knows the tissue: an outline is coordinates and nothing else.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <ctime>
#include <functional>
#include <limits>
#include <string>

#include "boundary/meshes.h"
#include "boundary/outline_repairs.h"
#include "boundary/polygons.h"
#include "boundary/small_stack.h"
#include "palpation/boundary/level_set.h"

namespace palpation {
namespace {

using testing::box;
using testing::contains;
using testing::even_odd;
using testing::pinwheel;
using testing::refusal;
using testing::region_of;
using testing::reversed;
using testing::same;
using testing::star;

OutlineRepairs repairs(Ring outer, std::vector<Ring> holes = {}) {
  return repairs_of(std::array{PolygonWithHoles{std::move(outer), std::move(holes)}});
}

TEST(PolygonCatalogue, P01_ABowTieIsRefusedWithTheEdgesAndTheirCrossing) {
  EXPECT_EQ(refusal([] {
              region_of({{0, 0}, {2, 2}, {2, 0}, {0, 2}});
            }),
            "Region: the outer ring must not cross itself, as its edges 0, from (0 0) to (2 2), "
            "and 2, from (2 0) to (0 2), do at (1 1)");
  // The second polygon, its first hole, with points repeated before the crossing: edges keep the
  // numbers that they were given with.
  const std::vector<PolygonWithHoles> two{
      {box(20, 0, 29, 9), {}},
      {box(0, 0, 9, 9), {{{1, 1}, {1, 1}, {1, 1}, {5, 5}, {5, 1}, {1, 4}}}}};
  const std::string message = refusal([&] { Region region(two); });
  EXPECT_TRUE(contains(message, "hole 0 of polygon 1 must not cross itself")) << message;
  EXPECT_TRUE(contains(message,
                       "edges 2, from (1 1) to (5 5), and 4, from (5 1) to (1 4), do at "
                       "(2.7142857142857144 2.7142857142857144)"))
      << message;
  // Meant as even-odd, it is two triangles.
  EXPECT_EQ(even_odd({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}).area(), 2.0);
  EXPECT_EQ(even_odd({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}).polygons().size(), 2u);
}

TEST(PolygonCatalogue, P01_ACrossingIsToldFromAPinchAndFoundAtVerticesToo) {
  // A pinch at (0 0), which is no fault, is lower than the crossing.
  const Ring pinched_and_crossed{{0, 0}, {1, -1}, {2, 0},  {6, 4},  {6, 0},
                                 {2, 4}, {0, 0},  {-1, 1}, {-2, 0}, {-1, -1}};
  const std::string message = refusal([&] { region_of(pinched_and_crossed); });
  EXPECT_TRUE(
      contains(message, "edges 2, from (2 0) to (6 4), and 4, from (6 0) to (2 4), do at (4 2)"))
      << message;
  // Both passes have a corner where they cross.
  EXPECT_TRUE(contains(refusal([] {
                         region_of({{0, 0}, {1, 1}, {2, 2}, {2, 0}, {1, 1}, {0, 2}});
                       }),
                       "do at (1 1)"));
  // Twice around: no place is outside between the turns, and still the inner turn crosses the outer
  // one.
  EXPECT_TRUE(
      contains(refusal([] {
                 region_of({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {3, 1}, {3, 3}, {-1, 3}});
               }),
               "must not cross itself"));
  // Squares joined at a corner, one run through the other way round.
  EXPECT_TRUE(
      contains(refusal([] {
                 region_of({{0, 0}, {1, 0}, {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}, {0, 1}});
               }),
               "do at (1 1)"));
}

TEST(PolygonCatalogue, P01_ARingThatRunsAlongItselfIsRefusedWithTheEdges) {
  // Two squares joined by a bridge of no width, once there and once back.
  const Ring dumbbell{{0, 0}, {1, 0}, {1, 1}, {3, 1}, {3, 0}, {4, 0},
                      {4, 2}, {3, 2}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};
  EXPECT_EQ(refusal([&] { region_of(dumbbell); }),
            "Region: the outer ring must not touch itself along a line, as its edges 2, from (1 1) "
            "to (3 1), and 8, from (3 1) to (1 1), do from "
            "(1 1) to (3 1)");
}

TEST(PolygonCatalogue, P02_RingsMayRunEitherWayRound) {
  const Region forwards = region_of(box(0, 0, 3, 3), {box(1, 1, 2, 2)});
  const Region backwards = region_of(reversed(box(0, 0, 3, 3)), {reversed(box(1, 1, 2, 2))});
  EXPECT_EQ(forwards.area(), 8.0);
  EXPECT_EQ(backwards.area(), 8.0);
  EXPECT_TRUE(same(forwards, backwards));
  EXPECT_EQ(backwards.polygons()[0].outer, box(0, 0, 3, 3));
  EXPECT_EQ(backwards.polygons()[0].holes[0], (Ring{{1, 1}, {1, 2}, {2, 2}, {2, 1}}));
}

TEST(PolygonCatalogue, P03_RepeatedCornersAreDroppedAndCounted) {
  const Ring untidy{{0, 0}, {0, 0}, {2, 0}, {2, 2}, {2, 2}, {2, 2}, {0, 2}, {0, 0}};
  EXPECT_TRUE(same(region_of(untidy), region_of(box(0, 0, 2, 2))));
  EXPECT_EQ(region_of(untidy).polygons()[0].outer, box(0, 0, 2, 2));
  EXPECT_EQ(repairs(untidy).repeated_corners, 4);
  EXPECT_EQ(repairs(untidy).words(), std::vector<std::string>{"4 repeated corners were left out"});
  EXPECT_EQ(repairs(box(0, 0, 2, 2)).repeated_corners, 0);
  EXPECT_TRUE(repairs(box(0, 0, 2, 2)).words().empty());
}

TEST(PolygonCatalogue, P04_ARingThatTouchesItselfAtAPointIsCutThere) {
  const Region two_squares =
      region_of({{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 1}, {0, 1}});
  EXPECT_EQ(two_squares.area(), 2.0);
  EXPECT_EQ(two_squares.polygons().size(), 2u);
  // An outline that reaches its own hole at one corner.
  const Region pinched =
      region_of({{0, 0}, {4, 0}, {4, 4}, {2, 4}, {3, 2}, {1, 2}, {2, 4}, {0, 4}});
  EXPECT_EQ(pinched.area(), 14.0);
  ASSERT_EQ(pinched.polygons().size(), 1u);
  EXPECT_EQ(pinched.polygons()[0].holes.size(), 1u);
  // A corner in the middle of another edge.
  EXPECT_EQ(region_of({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}).polygons().size(), 2u);
}

TEST(PolygonCatalogue, P05_WhatHasNoAreaIsEmptyAndCounted) {
  for (const Ring& nothing :
       {Ring{}, Ring{{1, 1}}, Ring{{1, 1}, {2, 2}}, Ring{{1, 1}, {1, 1}, {1, 1}, {1, 1}},
        Ring{{0, 0}, {1, 1}, {3, 3}, {2, 2}}}) {
    EXPECT_TRUE(region_of(nothing).empty());
    EXPECT_EQ(repairs(nothing).rings_without_area, 1);
    EXPECT_EQ(repairs(nothing).repeated_corners, 0);
  }
  EXPECT_EQ(region_of(box(0, 0, 3, 3), {{{1, 1}, {2, 2}}}).area(), 9.0);
  EXPECT_EQ(repairs(box(0, 0, 3, 3), {{{1, 1}, {2, 2}}}).words(),
            std::vector<std::string>{"1 ring without area was left out"});
}

TEST(PolygonCatalogue, P06_SpikesOfNoWidthAreDroppedAndCounted) {
  const Ring spiky{{0, 0}, {1, 0}, {2, 0},  {2, 2},  {2, 5},
                   {2, 2}, {0, 2}, {-7, 2}, {-3, 2}, {0, 2}};
  ASSERT_EQ(region_of(spiky).polygons().size(), 1u);
  EXPECT_EQ(region_of(spiky).polygons()[0].outer, box(0, 0, 2, 2));
  EXPECT_EQ(repairs(spiky).spike_corners, 3);
  // Where the ring starts and ends.
  for (const Ring& ring : {Ring{{5, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}, {2, 0}},
                           Ring{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}, {0, -4}}}) {
    EXPECT_TRUE(same(region_of(ring), region_of(box(0, 0, 2, 2))));
    EXPECT_EQ(repairs(ring).spike_corners, 1);
  }
  // A spike with a spike of its own.
  EXPECT_TRUE(same(region_of({{0, 0}, {2, 0}, {2, 2}, {2, 9}, {1, 9}, {2, 9}, {2, 2}, {0, 2}}),
                   region_of(box(0, 0, 2, 2))));
}

TEST(PolygonCatalogue, P07_ASpikeThinnerThanAnythingRealIsExact) {
  for (const double width : {1e-10, 1e-15, std::ldexp(1.0, -200)}) {
    const Region spiky =
        region_of({{0, 0}, {1, 0}, {1, 1}, {0.5, 1}, {0.25, 8}, {0.5 - width, 1}, {0, 1}});
    const Region square = region_of(box(0, 0, 1, 1));
    EXPECT_EQ(subtract(square, spiky).area(), 0.0);
    // A triangle 7 high on a base of the width, or what doubles make of it.
    const double base = 0.5 - (0.5 - width);
    EXPECT_DOUBLE_EQ(subtract(spiky, square).area(), 3.5 * base);
    EXPECT_EQ(subtract(spiky, square).empty(), base == 0.0);
    EXPECT_TRUE(same(unite(square, subtract(spiky, square)), spiky));
  }
}

TEST(PolygonCatalogue, P08_ARegionLessItselfIsEmptyWithAnAreaOfExactlyZero) {
  Random random(17);
  for (int trial = 0; trial < 20; ++trial) {
    const Region a =
        region_of(star(random, {0.3, 0.1}, 1.0, 60), {star(random, {0.3, 0.1}, 0.3, 20)});
    EXPECT_TRUE(symmetric_difference(a, a).empty());
    EXPECT_EQ(symmetric_difference(a, a).area(), 0.0);
    EXPECT_EQ(overlap_areas(a, a).only_a_m2, 0.0);
    EXPECT_EQ(overlap_areas(a, a).both_m2, a.area());
    EXPECT_TRUE(subtract(a, a).empty());
    EXPECT_TRUE(same(unite(a, a), a));
    EXPECT_TRUE(same(intersect(a, a), a));
  }
  const Region a = region_of(box(0, 0, 4, 4));
  EXPECT_TRUE(same(unite(a, Region()), a));
  EXPECT_TRUE(same(subtract(a, Region()), a));
  EXPECT_TRUE(intersect(a, Region()).empty());
  EXPECT_TRUE(unite(Region(), Region()).empty());
}

TEST(PolygonCatalogue, P09_RegionsThatShareAnEdgeOrAVertexOrLieInsideOrApartHaveExactAreas) {
  const Region left = region_of(box(0, 0, 2, 2));
  const Region right = region_of(box(2, 0, 4, 2));
  ASSERT_EQ(unite(left, right).polygons().size(), 1u);
  EXPECT_EQ(unite(left, right).polygons()[0].outer, box(0, 0, 4, 2));  // no seam
  EXPECT_TRUE(intersect(left, right).empty());                         // and no sliver
  const Region beyond_corner = region_of(box(2, 2, 3, 3));
  EXPECT_TRUE(intersect(left, beyond_corner).empty());
  EXPECT_EQ(unite(left, beyond_corner).polygons().size(), 2u);
  EXPECT_EQ(unite(left, beyond_corner).area(), 5.0);
  const Region inside = region_of(box(0.5, 0.5, 1, 1));
  EXPECT_EQ(subtract(left, inside).area(), 3.75);
  EXPECT_TRUE(same(intersect(left, inside), inside));
  EXPECT_EQ(symmetric_difference(left, region_of(box(7, 7, 8, 8))).area(), 5.0);
}

TEST(PolygonCatalogue, P10_EdgesThatCoincideInPartAndRunTheOtherWayAreExact) {
  // Along y = 1 from 1 to 3, one above the other.
  const Region below = region_of({{0, 0}, {4, 0}, {3, 1}, {1, 1}});
  const Region above = region_of({{2, 1}, {6, 1}, {5, 3}, {1.5, 3}});
  EXPECT_TRUE(intersect(below, above).empty());
  EXPECT_EQ(unite(below, above).polygons().size(), 1u);
  EXPECT_EQ(unite(below, above).area(), 3.0 + 7.5);
  // Along a slanted line on which no corner is a double: thirds of (1, 3), with the corners that
  // doubles give.
  const Region one = region_of({{0, 0}, {1, 3}, {-2, 2}});
  const Region other = region_of({{0, 0}, {3, 1}, {1, 3}});
  EXPECT_TRUE(intersect(one, other).empty());
  EXPECT_EQ(unite(one, other).polygons().size(), 1u);
}

TEST(PolygonCatalogue, P11_AHoleMayTouchTheOuterRingAndOtherHoles) {
  EXPECT_EQ(region_of(box(0, 0, 4, 4), {{{0, 0}, {2, 1}, {1, 2}}}).area(), 16.0 - 1.5);
  EXPECT_EQ(region_of(box(0, 0, 4, 4), {box(0, 0, 1, 1)}).area(), 15.0);
  EXPECT_TRUE(region_of(box(0, 0, 4, 4), {box(0, 0, 4, 4)}).empty());
  EXPECT_EQ(region_of(box(0, 0, 9, 9), {box(1, 1, 4, 4), box(4, 4, 6, 6)}).area(),
            81.0 - 9.0 - 4.0);
  EXPECT_EQ(region_of(box(0, 0, 9, 9), {box(1, 1, 4, 4), box(4, 1, 6, 4)}).area(),
            81.0 - 9.0 - 6.0);
}

TEST(PolygonCatalogue, P11_AHoleOutsideItsOuterRingIsRefusedByName) {
  EXPECT_EQ(refusal([] { region_of(box(0, 0, 3, 3), {box(5, 5, 6, 6)}); }),
            "Region: hole 0 must be inside its outer ring, as a hole is not near (5 5)");
  EXPECT_EQ(refusal([] {
              region_of(box(0, 0, 9, 9),
                        {box(1, 1, 2, 2), box(4, 4, 5, 5), box(8, 8, 12, 9), box(6, 6, 7, 7)});
            }),
            "Region: hole 2 must be inside its outer ring, as a hole is not near (9 8)");
  EXPECT_TRUE(contains(refusal([] { region_of({}, {box(1, 1, 4, 4)}); }),
                       "hole 0 must be inside its outer ring"));
}

TEST(PolygonCatalogue, P11_HolesThatOverlapAreRefusedByName) {
  EXPECT_EQ(refusal([] {
              region_of(box(0, 0, 9, 9),
                        {box(6, 6, 8, 8), box(1, 1, 4, 4), box(6, 1, 8, 3), box(3, 3, 5, 5)});
            }),
            "Region: holes 1 and 3 must not overlap, as holes do near (3 3)");
  EXPECT_TRUE(contains(refusal([] {
                         region_of(box(0, 0, 9, 9), {box(1, 1, 4, 4), box(1, 1, 4, 4)});
                       }),
                       "holes 0 and 1 must not overlap"));
}

TEST(PolygonCatalogue, P12_CoordinatesThatAreNoPlaceAreRefusedBeforeAnyWork) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity}) {
    const std::string message = refusal([&] { region_of({{0, 0}, {1, bad}, {1, 1}}); });
    EXPECT_EQ(message,
              "Region: corner 1 of the outer ring, (1 " + text_of(bad) + "), must be finite");
    EXPECT_TRUE(contains(refusal([&] {
                           even_odd({box(0, 0, 1, 1), {{0, 0}, {bad, 1}, {1, 1}}});
                         }),
                         "corner 1 of ring 1, ("));
    EXPECT_TRUE(contains(refusal([&] {
                           static_cast<void>(Region().contains({bad, 0}));
                         }),
                         "must be finite"));
    EXPECT_TRUE(contains(refusal([&] { repairs({{0, 0}, {1, bad}, {1, 1}}); }), "must be finite"));
  }
  EXPECT_EQ(refusal([] {
              region_of({{0, 0}, {1e300, 0}, {1, 1}});
            }),
            "Region: corner 1 of the outer ring, (1e+300 0), must be within 1e9 m of the origin");
  EXPECT_TRUE(contains(
      refusal([] {
        region_of({{0, 0}, {1e-300, 0}, {1e-300, 1e-300}});
      }),
      "the outer ring must reach farther than 1e-100 m from the origin, and only reaches 1e-300"));
  // Tiny coordinates beside others are as good as any.
  EXPECT_EQ(region_of({{1e-300, 0}, {1, -1e-300}, {1, 1}, {0, 1}}).polygons().size(), 1u);
  EXPECT_EQ(region_of(box(-1e9, -1e9, 1e9, 1e9)).area(), 4e18);
}

// A million are tried by tests/sweeps/sweep_sizes.cpp, on a stack of 256 kB.
TEST(PolygonCatalogue, P13_AnOutlineOfManyCornersTakesNoStack) {
  bool done = false;
  testing::on_a_small_stack([&] {
    Random random(16);
    const Region a = region_of(star(random, {0, 0}, 1.0, 8000));
    Region b = region_of(star(random, {5, 0}, 1.0, 8000));
    b = unite(a, b);
    const double area = b.area();
    b = Region();
    done = area > a.area();
  });
  EXPECT_TRUE(done);
}

/// Of the processor, whatever else the machine does.
double seconds_of(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

TEST(PolygonCatalogue, P13_ALongFlatOutlineTakesTimeThatGrowsWithItsCorners) {
  // All corners but one on a line, far longer than high: cut across it, not along it. It takes a
  // fifth of a second.
  Ring flat;
  for (int i = 0; i < 40'000; ++i) flat.emplace_back(i, 0);
  flat.emplace_back(40'000, 5);
  EXPECT_LT(seconds_of([&] { EXPECT_EQ(region_of(flat).polygons()[0].outer.size(), 3u); }), 20.0);
}

// Ten thousand spikes are tried by tests/sweeps/sweep_sizes.cpp.
TEST(PolygonCatalogue, P14_OutlinesThatCrossMillionsOfTimesAreRefusedBeforeTheWork) {
  const Region a = even_odd({pinwheel(3000, 1.0)});
  const Region b = even_odd({pinwheel(3000, -1.0)});
  std::string message;
  // It takes some hundredths of a second; the overlay itself would take minutes and gigabytes.
  EXPECT_LT(seconds_of([&] { message = refusal([&] { intersect(a, b); }); }), 30.0);
  EXPECT_EQ(
      message,
      "intersect: the rings' edges may cross, overlap or meet in a crowd at most 500000 times");
  // Against itself turned by a little, each spike crosses few others: that is done.
  const Ring wheel = pinwheel(1000, 0.02);
  Ring turned;
  for (const Vec2& corner : wheel) turned.push_back(Eigen::Rotation2Dd(0.001) * corner);
  EXPECT_GT(intersect(region_of(wheel), region_of(turned)).area(), 0.5);
}

TEST(PolygonCatalogue, P14_EdgesThatRunAlongEachOtherAreCountedToo) {
  // A thousand equal boxes: an even number of times around is outside. Their edges are merged.
  EXPECT_LT(
      seconds_of([] { EXPECT_TRUE(even_odd(std::vector<Ring>(1000, box(0, 0, 1, 1))).empty()); }),
      10.0);
  EXPECT_TRUE(same(even_odd(std::vector<Ring>(1001, box(0, 0, 1, 1))), region_of(box(0, 0, 1, 1))));
  // To and fro along one line, never the same way twice.
  Ring to_and_fro;
  for (int i = 0; i < 3000; ++i) {
    to_and_fro.emplace_back(i, 0);
    to_and_fro.emplace_back(6000 - i, 0);
  }
  to_and_fro.emplace_back(3000, 5);
  EXPECT_TRUE(contains(refusal([&] { even_odd({to_and_fro}); }),
                       "may cross, overlap or meet in a crowd at most"));
  to_and_fro.erase(to_and_fro.begin() + 200, to_and_fro.end() - 1);
  // One triangle is left of it, from (0 0) over (5901 0) to (3000 5).
  EXPECT_EQ(even_odd({to_and_fro}).area(), 14752.5);
}

TEST(PolygonCatalogue, P14_SpikesThatCrowdAtOnePointAreCountedToo) {
  const auto fan = [](int spikes) {
    Ring ring;
    for (int i = 0; i < spikes; ++i) {
      ring.emplace_back(0.0, 0.0);
      for (const double side : {0.0, 0.5})
        ring.emplace_back(std::cos((i + side) / spikes), std::sin((i + side) / spikes));
    }
    return ring;
  };
  EXPECT_TRUE(contains(refusal([&] { region_of(fan(20'000)); }), "meet in a crowd"));
  EXPECT_EQ(region_of(fan(100)).polygons().size(), 100u);
}

TEST(PolygonCatalogue, P16_WhatLiesBesideTheTissueIsCutOffByTheTissuesOwnRegion) {
  const Surface tissue = testing::square_ring();
  const Region whole = superlevel_region(tissue, Field::Zero(tissue.vertex_count()), 0.0);
  const Region outline = region_of(box(0.5, 0.5, 1.5, 1.5));
  // A quarter of the square less a quarter of its hole.
  EXPECT_NEAR(intersect(outline, whole).area(), 0.25 - 0.25 / 9.0, 1e-15);
  EXPECT_NEAR(subtract(outline, whole).area(), 0.75 + 0.25 / 9.0, 1e-15);
}

}  // namespace
}  // namespace palpation
