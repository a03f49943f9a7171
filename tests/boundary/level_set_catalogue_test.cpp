// What can be asked of a level set, row by row of the catalogue of boundaries: B01 to B17. Every
// row is tried on flat tissue and, as far as it makes sense there, on curved tissue: a cylinder's
// quarter, a dome with a hole, a torus, an octahedron, a tent.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "boundary/level_remarks.h"
#include "boundary/loop_laws.h"
#include "boundary/meshes.h"
#include "boundary/small_stack.h"
#include "palpation/boundary/level_set.h"

namespace palpation {
namespace {

using testing::cylinder_patch;
using testing::dome_with_hole;
using testing::fan;
using testing::field_of;
using testing::octahedron;
using testing::torus;
using testing::unit_square;

struct Named {
  std::string name;
  Surface surface;
};

std::vector<Named> with_borders() {
  return {{"square", unit_square(9, 0.3)},
          {"square with a hole", testing::square_ring()},
          {"cylinder's quarter", cylinder_patch(9)},
          {"dome with a hole", dome_with_hole()},
          {"tent", fan(0.5)}};
}

std::vector<Named> closed() {
  return {
      {"octahedron", octahedron()}, {"torus", torus()}, {"ball", Surface(zoo::icosphere_mesh(2))}};
}

std::vector<Named> all_kinds() {
  std::vector<Named> all = with_borders();
  for (Named& more : closed()) all.push_back(std::move(more));
  return all;
}

/// The loops, after they have kept every law of loop_laws.h, and the region too where there is a
/// chart.
std::vector<LevelLoop> lawful_loops(const Surface& surface, const Field& field, double level) {
  const std::vector<LevelLoop> loops = level_loops(surface, field, level);
  const testing::LoopReport report = testing::report_on_loops(surface, field, level, loops);
  EXPECT_EQ(report.fault, "");
  // Hundreds of faces, each rounded.
  EXPECT_LE(report.area_difference, 1e-13);
  if (surface.has_chart()) {
    EXPECT_NEAR(surface_area(surface, superlevel_region(surface, field, level)),
                superlevel_area(surface, field, level), 1e-13 * surface.area());
  }
  return loops;
}

/// How many pieces of a loop run along the border.
long border_pieces(const LevelLoop& loop) {
  return std::count(loop.on_border.begin(), loop.on_border.end(), true);
}

double length_of(const Surface& surface, const LevelLoop& loop) {
  double sum = 0.0;
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    sum += (surface.position(loop.points[(i + 1) % loop.points.size()]) -
            surface.position(loop.points[i]))
               .norm();
  }
  return sum;
}

Field height(const Surface& surface) {
  return field_of(surface, [](const Vec3& p) { return p.x() + 0.5 * p.y() + 0.25 * p.z(); });
}

TEST(LevelSetCatalogue, B01_NothingIsInsideWhereAllIsBelow) {
  for (const auto& [name, surface] : all_kinds()) {
    const Field field = height(surface);
    const double above_all = std::nextafter(field.maxCoeff(), 1e9);
    EXPECT_TRUE(lawful_loops(surface, field, above_all).empty()) << name;
    EXPECT_EQ(superlevel_area(surface, field, above_all), 0.0) << name;
    EXPECT_TRUE(!surface.has_chart() || superlevel_region(surface, field, above_all).empty())
        << name;
  }
}

TEST(LevelSetCatalogue, B02_AllTissueIsInsideWhereAllIsAboveOrAtTheLevel) {
  for (const auto& [name, surface] : all_kinds()) {
    const Field field = height(surface);
    for (const auto& [values, level] :
         {std::pair(field, field.minCoeff() - 1.0),
          std::pair(Field(Field::Constant(field.size(), 2.5)), 2.5)}) {
      // The borders are the boundary. A closed surface has none, yet all of it is inside.
      const std::vector<LevelLoop> loops = lawful_loops(surface, values, level);
      ASSERT_EQ(loops.size(), surface.border_loops().size()) << name;
      for (const LevelLoop& loop : loops)
        EXPECT_EQ(border_pieces(loop), static_cast<long>(loop.points.size())) << name;
      EXPECT_NEAR(superlevel_area(surface, values, level), surface.area(), 1e-14 * surface.area())
          << name;
    }
  }
}

// Half of the tissue: the line leaves over the border and comes back along it.
TEST(LevelSetCatalogue, B02_AComponentThatIsAllAtTheLevelIsInsideBesideOthersThatAreNot) {
  const TriangleMesh sheet = zoo::unit_square_mesh(4);
  const Eigen::Matrix3d same = Eigen::Matrix3d::Identity();
  for (const TriangleMesh& other :
       {zoo::moved(sheet, same, Vec3(2.0, 0.0, 0.0)),
        zoo::moved(zoo::icosphere_mesh(1), same, Vec3(3.0, 0.0, 0.0))}) {
    const Surface two(zoo::together(sheet, other));
    const Field field = field_of(two, [](const Vec3& p) { return p.x() > 1.5 ? 1.0 : p.x(); });
    EXPECT_EQ(lawful_loops(two, field, 1.0).size(),
              two.topology().is_closed() ? 0u : two.border_loops().size() - 1);
    EXPECT_NEAR(superlevel_area(two, field, 1.0), two.area() - 1.0, 1e-13);
  }
}

TEST(LevelSetCatalogue, B03_ALineThatMeetsTheBorderIsClosedAlongIt) {
  const Surface square = unit_square(9);
  const Field left = field_of(square, [](const Vec3& p) { return 1.0 - p.x(); });
  const std::vector<LevelLoop> loops = lawful_loops(square, left, 0.5);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(border_pieces(loops[0]),
            9 + 2 * 5);  // the left side, and five pieces each of bottom and top
  const Region stiff = superlevel_region(square, left, 0.5);
  ASSERT_EQ(stiff.polygons().size(), 1u);
  EXPECT_NEAR(surface_area(square, stiff), 0.5, 1e-12);
  EXPECT_TRUE(stiff.contains({0.0, 1.0}));
  EXPECT_FALSE(stiff.contains({0.51, 0.5}));

  const Surface quarter = cylinder_patch(9);
  const std::vector<LevelLoop> upper =
      lawful_loops(quarter, field_of(quarter, [](const Vec3& p) { return p.z(); }), 0.5);
  ASSERT_EQ(upper.size(), 1u);
  EXPECT_EQ(border_pieces(upper[0]), 9 + 2 * 5);
  EXPECT_NEAR(superlevel_area(quarter, field_of(quarter, [](const Vec3& p) { return p.z(); }), 0.5),
              0.5 * quarter.area(), 1e-14);
}

TEST(LevelSetCatalogue, B03_ALineMayMeetTheBorderAtOneVertexAtACornerOrAlongAnEdge) {
  for (const Surface& star : {fan(), fan(0.5)}) {
    for (const auto& [inside, points] :
         {std::pair(std::vector{0, 1}, 5u), std::pair(std::vector{2}, 4u),
          std::pair(std::vector{2, 3}, 5u)}) {
      Field field = Field::Zero(9);
      for (const int vertex : inside) field[vertex] = 2.0;
      const std::vector<LevelLoop> loops = lawful_loops(star, field, 1.0);
      ASSERT_EQ(loops.size(), 1u);
      EXPECT_GE(loops[0].points.size(), points);
      EXPECT_GE(border_pieces(loops[0]), 2);
    }
    // Only just reached, at a vertex of the border or along one of its edges, the inside is
    // nothing.
    Field corner = Field::Zero(9);
    corner[2] = 1.0;
    EXPECT_TRUE(lawful_loops(star, corner, 1.0).empty());
    Field edge = corner;
    edge[3] = 1.0;
    EXPECT_TRUE(lawful_loops(star, edge, 1.0).empty());
    // The middle is inside and the border at the level in one vertex: the loop touches the border
    // there and does not follow it.
    Field touch = Field::Zero(9);
    touch[0] = 2.0;
    touch[1] = 1.0;
    ASSERT_EQ(lawful_loops(star, touch, 1.0).size(), 1u);
    EXPECT_EQ(border_pieces(lawful_loops(star, touch, 1.0)[0]), 0);
  }
}

TEST(LevelSetCatalogue, B04_ALineThatCrossesTheBorderManyTimesBoundsSeveralRegions) {
  for (const Surface& star : {fan(), fan(0.5)}) {
    Field corners = Field::Zero(9);
    corners[2] = corners[4] = corners[6] = corners[8] = 1.0;
    EXPECT_EQ(lawful_loops(star, corners, 0.5).size(), 4u);
  }
  // Each corner cell keeps two triangles (half a cell each) with a tip of a quarter.
  Field corners = Field::Zero(9);
  corners[2] = corners[4] = corners[6] = corners[8] = 1.0;
  EXPECT_EQ(superlevel_region(fan(), corners, 0.5).area(), 1.0);
  EXPECT_EQ(superlevel_region(fan(), corners, 0.5).polygons().size(), 4u);

  // Six stripes over the dome, from its rim to its hole: each crosses both borders twice.
  const Surface dome = dome_with_hole(48, 8);
  const std::vector<LevelLoop> stripes = lawful_loops(
      dome,
      field_of(dome, [](const Vec3& p) { return std::cos(6.0 * std::atan2(p.y(), p.x()) + 0.1); }),
      0.2);
  EXPECT_EQ(stripes.size(), 6u);
}

TEST(LevelSetCatalogue, B05_LoopsComeByFallingLengthThenByTheFaceOfTheirFirstPoint) {
  Random random(10);
  for (const auto& [name, surface] : all_kinds()) {
    for (int trial = 0; trial < 5; ++trial) {
      const std::vector<LevelLoop> loops =
          lawful_loops(surface, testing::rough_field(surface, random), 0.7);
      for (std::size_t i = 1; i < loops.size(); ++i) {
        const double before = length_of(surface, loops[i - 1]);
        EXPECT_LE(length_of(surface, loops[i]), before * (1.0 + 1e-15)) << name;
      }
    }
  }
  // Four loops of one length.
  Field corners = Field::Zero(9);
  corners[2] = corners[4] = corners[6] = corners[8] = 1.0;
  const std::vector<LevelLoop> equal = lawful_loops(fan(), corners, 0.5);
  ASSERT_EQ(equal.size(), 4u);
  for (std::size_t i = 1; i < equal.size(); ++i)
    EXPECT_LT(equal[i - 1].points[0].face, equal[i].points[0].face);
}

TEST(LevelSetCatalogue, B06_NestedLoopsAreHolesAndIslands) {
  const Surface square = unit_square(60, 0.2);
  const Field field = field_of(
      square, [](const Vec3& p) { return std::cos(20.0 * std::hypot(p.x() - 0.5, p.y() - 0.5)); });
  // cos(20 r) >= 1/2: r <= 0.0524, 0.2618 <= r <= 0.3665, and an arc across each corner, from
  // 0.5760 to 0.6807.
  EXPECT_EQ(lawful_loops(square, field, 0.5).size(), 7u);
  const Region region = superlevel_region(square, field, 0.5);
  const auto polygons = region.polygons();
  ASSERT_EQ(polygons.size(), 6u);
  EXPECT_EQ(polygons[0].holes.size(), 1u);
  EXPECT_TRUE(region.contains({0.5, 0.5}));
  EXPECT_FALSE(region.contains({0.65, 0.5}));
  EXPECT_TRUE(region.contains({0.5, 0.81}));
  EXPECT_TRUE(region.contains({0.94, 0.06}));
  EXPECT_FALSE(region.contains({0.99, 0.01}));

  // The same on a cylinder's quarter, its arc taken for the side of a square: the laws hold every
  // loop to the inside on its left.
  const Surface quarter = cylinder_patch(60);
  const Field rings = field_of(quarter, [](const Vec3& p) {
    return std::cos(
        20.0 * std::hypot(2.0 / std::numbers::pi * std::atan2(p.y(), p.x()) - 0.5, p.z() - 0.5));
  });
  EXPECT_EQ(lawful_loops(quarter, rings, 0.5).size(), 7u);
}

// High in the north-east and the south-west, low elsewhere, the middle at the level itself: two
// quarters that touch at a vertex.
Field saddle_field() {
  return (Field(9) << 1.0, 1.0, 2.0, 1.0, 0.0, 1.0, 2.0, 1.0, 0.0).finished();
}

TEST(LevelSetCatalogue, B07_TangentLoopsAreSplitAtThePinch) {
  for (const Surface& star : {fan(), fan(0.5)})
    EXPECT_EQ(lawful_loops(star, saddle_field(), 1.0).size(), 2u);
  const auto squares = superlevel_region(fan(), saddle_field(), 1.0).polygons();
  ASSERT_EQ(squares.size(), 2u);
  EXPECT_EQ(squares[0].outer, (Ring{{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}));
  EXPECT_EQ(squares[1].outer, (Ring{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));

  // All is inside but two quarters that touch at the middle: one loop around the whole, cut in two
  // as well.
  for (const Surface& star : {fan(), fan(0.5)})
    EXPECT_EQ(lawful_loops(star, -saddle_field(), -1.0).size(), 2u);
  // Around the top of the octahedron two lobes, which touch at its tip and at its foot.
  const Surface solid = octahedron();
  EXPECT_EQ(
      lawful_loops(solid,
                   field_of(solid, [](const Vec3& p) { return std::abs(p.x()) - std::abs(p.y()); }),
                   0.0)
          .size(),
      2u);
}

TEST(LevelSetCatalogue, B08_ALineThroughVerticesVisitsEachOnceAndIsClosed) {
  // x + 2y = 1.2 on a lattice of tenths: every other vertex on the way is hit (the values are
  // eighths, so exactly).
  const Surface square(
      zoo::moved(zoo::unit_square_mesh(8), Eigen::Matrix3d::Identity(), Vec3::Zero()));
  const auto slanted = [](const Vec3& p) { return p.x() + 2.0 * p.y(); };
  ASSERT_EQ(lawful_loops(square, field_of(square, slanted), 1.25).size(), 1u);
  EXPECT_NEAR(superlevel_region(square, field_of(square, slanted), 1.25).area(), 0.625, 1e-15);

  // A cylinder's quarter, its cells numbered along and across.
  const Surface quarter = cylinder_patch(8);
  const Field cells = field_of(quarter, [](const Vec3& p) {
    return std::round(8.0 * std::atan2(p.y(), p.x()) / (0.5 * std::numbers::pi)) +
           2.0 * std::round(8.0 * p.z());
  });
  ASSERT_EQ(lawful_loops(quarter, cells, 10.0).size(), 1u);
  EXPECT_NEAR(superlevel_area(quarter, cells, 10.0), 0.625 * quarter.area(), 1e-14);
}

TEST(LevelSetCatalogue, B09_ALineAlongMeshEdgesIsThereOnce) {
  const Surface square = unit_square(10);
  const Field steps = field_of(
      square, [](const Vec3& p) { return p.x() > 0.55 ? 0.0 : (p.x() < 0.45 ? 2.0 : 1.0); });
  const std::vector<LevelLoop> loops = lawful_loops(square, steps, 1.0);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].points.size(), 30u);  // the border of the left 5 x 10 cells
  EXPECT_NEAR(superlevel_region(square, steps, 1.0).area(), 0.5, 1e-15);

  // The dome's fourth circle of vertices.
  const Surface dome = dome_with_hole(24, 8);
  const double fourth = std::sin(std::numbers::pi * 0.36 * 0.5);
  const Field rings =
      field_of(dome, [&](const Vec3& p) { return std::round(1e6 * (p.z() - fourth)); });
  const std::vector<LevelLoop> upper = lawful_loops(dome, rings, 0.0);
  ASSERT_EQ(upper.size(), 2u);
  EXPECT_EQ(upper[0].points.size(), 24u);
  EXPECT_EQ(border_pieces(upper[0]), 0);
  EXPECT_EQ(border_pieces(upper[1]), 24);
}

TEST(LevelSetCatalogue, B10_APlateauAtTheLevelIsInsideAndItsRimIsTheLine) {
  const Surface square = unit_square(10);
  const auto middle = [](const Vec3& p) {
    return p.x() > 0.25 && p.x() < 0.75 && p.y() > 0.25 && p.y() < 0.75 ? 1.0 : 0.0;
  };
  // Vertices 0.3 ... 0.7: the plateau is 0.4 wide, and at its own height nothing is added to it.
  EXPECT_NEAR(superlevel_region(square, field_of(square, middle), 1.0).area(), 0.16, 1e-15);
  const std::vector<LevelLoop> rim = lawful_loops(square, field_of(square, middle), 1.0);
  ASSERT_EQ(rim.size(), 1u);
  EXPECT_EQ(rim[0].points.size(), 16u);
  // A hollow whose floor is at the level is no hole.
  EXPECT_NEAR(superlevel_region(
                  square, field_of(square, [&](const Vec3& p) { return 2.0 - middle(p); }), 1.0)
                  .area(),
              1.0, 1e-15);

  // One face of the octahedron at the level, all else below.
  const Surface solid = octahedron();
  Field face = Field::Zero(6);
  face[0] = face[2] = face[4] = 1.0;
  ASSERT_EQ(lawful_loops(solid, face, 1.0).size(), 1u);
  EXPECT_NEAR(superlevel_area(solid, face, 1.0), solid.area() / 8.0, 1e-15);
  // A strip around the torus.
  const Surface ring = torus();
  const Field strip = field_of(ring, [](const Vec3& p) {
    return std::abs(p.z()) < 0.5 && std::hypot(p.x(), p.y()) > 2.0 ? 1.0 : 0.0;
  });
  EXPECT_EQ(lawful_loops(ring, strip, 1.0).size(), 2u);
}

TEST(LevelSetCatalogue, B10_PeaksAndRidgesThatOnlyJustReachTheLevelBoundNothing) {
  for (const Surface& star : {fan(), fan(0.5)}) {
    Field peak = Field::Zero(9);
    peak[0] = 1.0;
    EXPECT_TRUE(lawful_loops(star, peak, 1.0).empty());
    Field ridge = Field::Zero(9);
    ridge[0] = ridge[1] = ridge[5] = 1.0;  // from border to border
    EXPECT_TRUE(lawful_loops(star, ridge, 1.0).empty());
    EXPECT_EQ(superlevel_area(star, ridge, 1.0), 0.0);
  }
  // Ridges that close: a square in the plane, circles around a torus, the inner border of the dome.
  const Surface square = unit_square(10);
  const auto on_square = [](const Vec3& p) {
    return std::abs(std::max(std::abs(p.x() - 0.5), std::abs(p.y() - 0.5)) - 0.3) < 0.05 ? 1.0
                                                                                         : 0.0;
  };
  EXPECT_TRUE(lawful_loops(square, field_of(square, on_square), 1.0).empty());
  EXPECT_TRUE(superlevel_region(square, field_of(square, on_square), 1.0).empty());
  const Surface ring = torus();
  EXPECT_TRUE(
      lawful_loops(
          ring,
          field_of(ring, [](const Vec3& p) { return std::hypot(p.x(), p.y()) > 2.69 ? 1.0 : 0.0; }),
          1.0)
          .empty());
  const Surface dome = dome_with_hole();
  const double top = dome.mesh().vertices.col(2).maxCoeff();
  EXPECT_TRUE(
      lawful_loops(
          dome, field_of(dome, [&](const Vec3& p) { return p.z() > top - 1e-9 ? 1.0 : 0.0; }), 1.0)
          .empty());
  // A ridge from one plateau to another is no part of either.
  Field bridge = field_of(square, [](const Vec3& p) {
    return std::abs(p.x() - 0.5) > 0.25 && std::abs(p.y() - 0.5) < 0.25 ? 1.0 : 0.0;
  });
  for (int vertex = 0; vertex < square.vertex_count(); ++vertex) {
    if (std::abs(square.vertex(vertex).y() - 0.5) < 0.01) bridge[vertex] = 1.0;
  }
  EXPECT_EQ(lawful_loops(square, bridge, 1.0).size(), 2u);
}

TEST(LevelSetCatalogue, B11_ASaddleAtTheLevelHasTheAreaOfBothItsSidesAndAlwaysTheSameLoops) {
  const Surface star = fan();
  EXPECT_EQ(superlevel_region(star, saddle_field(), 1.0).area(), 2.0);
  EXPECT_EQ(superlevel_area(star, saddle_field(), 1.0), 2.0);
  // Just above the level the middle separates the two, just below it joins them: areas on either
  // side of 2, close to it.
  EXPECT_NEAR(superlevel_region(star, saddle_field(), 1.0 + 1e-9).area(), 2.0, 1e-8);
  EXPECT_EQ(superlevel_region(star, saddle_field(), 1.0 + 1e-9).polygons().size(), 2u);
  EXPECT_NEAR(superlevel_region(star, saddle_field(), 1.0 - 1e-9).area(), 2.0, 1e-8);
  EXPECT_EQ(superlevel_region(star, saddle_field(), 1.0 - 1e-9).polygons().size(), 1u);

  // Saddles everywhere: whichever way the faces are numbered, the same regions; asked twice, the
  // same loops to the bit.
  Random random(21);
  const TriangleMesh mesh = zoo::jittered_square_mesh(8, 5);
  for (int trial = 0; trial < 10; ++trial) {
    const Surface one(mesh);
    const Surface other(zoo::reordered(mesh, random));
    const Field field = testing::stepped_field(one, random);
    EXPECT_TRUE(symmetric_difference(superlevel_region(one, field, 1.0),
                                     superlevel_region(other, field, 1.0))
                    .empty());
    EXPECT_EQ(lawful_loops(one, field, 1.0).size(), level_loops(one, field, 1.0).size());
  }
  for (const auto& [name, surface] : all_kinds()) {
    const Field field = testing::stepped_field(surface, random);
    const std::vector<LevelLoop> first = lawful_loops(surface, field, 1.0);
    const std::vector<LevelLoop> second = level_loops(surface, field, 1.0);
    ASSERT_EQ(first.size(), second.size()) << name;
    for (std::size_t i = 0; i < first.size(); ++i) {
      ASSERT_EQ(first[i].points.size(), second[i].points.size()) << name;
      EXPECT_EQ(first[i].on_border, second[i].on_border) << name;
      for (std::size_t k = 0; k < first[i].points.size(); ++k) {
        EXPECT_EQ(first[i].points[k].face, second[i].points[k].face) << name;
        EXPECT_EQ(first[i].points[k].barycentric, second[i].points[k].barycentric) << name;
      }
    }
  }
}

TEST(LevelSetCatalogue, B12_AtTheLeastValueAllIsInsideAndAtTheGreatestOnlyAPoint) {
  for (const auto& [name, surface] : all_kinds()) {
    const Field field =
        field_of(surface, [](const Vec3& p) { return p.x() + 0.51 * p.y() + 0.253 * p.z(); });
    EXPECT_NEAR(superlevel_area(surface, field, field.minCoeff()), surface.area(),
                1e-14 * surface.area())
        << name;
    EXPECT_EQ(lawful_loops(surface, field, field.minCoeff()).size(), surface.border_loops().size())
        << name;
    EXPECT_TRUE(lawful_loops(surface, field, field.maxCoeff()).empty()) << name;
    EXPECT_EQ(superlevel_area(surface, field, field.maxCoeff()), 0.0) << name;
    // The point is told of.
    const LevelRemarks remarks = remarks_on_level_set(surface, field, field.maxCoeff());
    EXPECT_EQ(remarks.bare_vertices, 1) << name;
    ASSERT_EQ(remarks.words().size(), 1u) << name;
    EXPECT_EQ(remarks.words()[0], "1 vertex only just reaches the level and bounds no area");
    EXPECT_TRUE(remarks_on_level_set(surface, field, field.minCoeff()).words().empty()) << name;
  }
}

TEST(LevelSetCatalogue, B13_ValuesOneUnitInTheLastPlaceApartAreCutInsideTheEdge) {
  const double next = std::nextafter(1.0, 2.0);
  Random random(22);
  for (const auto& [name, surface] : all_kinds()) {
    const Field ulps =
        field_of(surface, [&](const Vec3&) { return random.below(2) == 0 ? 1.0 : next; });
    lawful_loops(surface, ulps, next);  // whose weights are fractions of one
    EXPECT_NEAR(superlevel_area(surface, ulps, 1.0), surface.area(), 1e-14 * surface.area())
        << name;
  }
  const Surface square = unit_square(9);
  const Field ulps = field_of(square, [&](const Vec3& p) { return p.x() < 0.5 ? next : 1.0; });
  EXPECT_NEAR(superlevel_region(square, ulps, next).area(), 4.0 / 9.0, 1e-15);
}

TEST(LevelSetCatalogue, B13_ValuesAtTheLimitsOfDoublesAreCutWhereTheyShouldBe) {
  constexpr double kMost = std::numeric_limits<double>::max();
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  const Surface square = unit_square(9);
  const auto split = [&](double left, double right) {
    return field_of(square, [=](const Vec3& p) { return p.x() < 0.5 ? left : right; });
  };
  EXPECT_NEAR(superlevel_region(square, split(kMost, -kMost), 0.0).area(), 0.5, 1e-13);
  EXPECT_NEAR(superlevel_area(square, split(kMost, -kMost), 0.0), 0.5, 1e-13);
  EXPECT_NEAR(superlevel_region(square, split(4.0 * kLeast, 0.0), 2.0 * kLeast).area(), 0.5, 1e-13);
  // One huge value far away takes nothing from the digits of tiny ones: the line stays in the
  // middle, and what is below stays outside.
  for (const double sign : {1.0, -1.0}) {
    Field mixed = split(300.0 * kLeast, -300.0 * kLeast);
    mixed[99] = sign * kMost;  // the upper right corner
    const double corner = sign > 0.0 ? 0.5 / 81.0 : 0.0;
    EXPECT_NEAR(superlevel_region(square, mixed, 0.0).area(), 0.5 + corner * 2.0, 0.5 / 81.0)
        << sign;
    EXPECT_TRUE(superlevel_region(square, mixed, 0.0).contains({0.499, 0.3}));
    EXPECT_FALSE(superlevel_region(square, mixed, 0.0).contains({0.501, 0.3}));
    lawful_loops(square, mixed, 0.0);
  }
}

/// Every second row of vertices is inside, joined to the next at alternate ends: one loop along all
/// of them.
Field snake(int cells) {
  Field field((cells + 1) * (cells + 1));
  for (int vertex = 0; vertex < field.size(); ++vertex) {
    const int row = vertex / (cells + 1);
    const int column = vertex % (cells + 1);
    const bool turn = column == (row % 4 == 1 ? cells - 1 : 1);
    const bool on_rim = row == 0 || column == 0 || row == cells || column == cells;
    field[vertex] = !on_rim && (row % 2 == 0 || turn) ? 1.0 : -1.0;
  }
  return field;
}

// A million pieces are tried by tests/sweeps/sweep_sizes.cpp, on a stack of 256 kB.
TEST(LevelSetCatalogue, B14_ALongBoundaryTakesNoStack) {
  std::size_t pieces = 0;
  testing::on_a_small_stack([&] {
    const Surface square = unit_square(100, 0.2);
    const std::vector<LevelLoop> loops = level_loops(square, snake(100), 0.0);
    const Region region = superlevel_region(square, snake(100), 0.0);
    if (loops.size() == 1 && region.polygons().size() == 1) pieces = loops[0].points.size();
  });
  EXPECT_GT(pieces, 19'000u);
}

TEST(LevelSetCatalogue, B15_ALoopSmallerThanATriangleIsKeptAndToldOf) {
  const Surface square = unit_square(10);
  // One vertex reaches above the level by a hundredth of the step to its neighbours.
  const auto peak = [](const Surface& surface, int vertex) {
    Field field = Field::Zero(surface.vertex_count());
    field[vertex] = 1.0;
    return field;
  };
  const Region speck = superlevel_region(square, peak(square, 60), 0.99);
  ASSERT_EQ(speck.polygons().size(), 1u);
  EXPECT_NEAR(speck.area(), superlevel_area(square, peak(square, 60), 0.99), 1e-18);
  EXPECT_GT(speck.area(), 1e-6);
  // And one that is a single triangle's corner.
  const std::vector<LevelLoop> corner = lawful_loops(square, peak(square, 0), 0.75);
  ASSERT_EQ(corner.size(), 1u);
  for (const auto& [name, surface] : all_kinds()) {
    const int vertex = surface.vertex_count() / 2;
    ASSERT_EQ(lawful_loops(surface, peak(surface, vertex), 0.99).size(), 1u) << name;
    const LevelRemarks remarks = remarks_on_level_set(surface, peak(surface, vertex), 0.99);
    EXPECT_EQ(remarks.small_loops, 1) << name;
    ASSERT_EQ(remarks.words().size(), 1u) << name;
    EXPECT_EQ(remarks.words()[0],
              "1 loop of the boundary is smaller than a triangle of the mesh, which cannot show "
              "how large it really is");
  }
}

std::string refusal(const Surface& surface) {
  try {
    superlevel_region(surface, Field::Ones(surface.vertex_count()), 0.5);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

// Of a flat mesh with a triangle turned over, and of sheets over each other, there is no region;
// their loops and areas in space stay right.
TEST(LevelSetCatalogue, B16_AFoldedOrDoubledChartIsRefusedInWords) {
  TriangleMesh folded = zoo::unit_square_mesh(4);
  folded.vertices.row(12) << 0.8, 0.5, 0.0;
  EXPECT_NE(refusal(Surface(folded)).find("a flat surface that is folded has no chart"),
            std::string::npos)
      << refusal(Surface(folded));
  const TriangleMesh square = zoo::unit_square_mesh(4);
  const Surface doubled(
      zoo::together(square, zoo::moved(square, Eigen::Matrix3d::Identity(), Vec3(0.5, 0.5, 0.0))));
  EXPECT_NE(refusal(doubled).find("lies over itself"), std::string::npos) << refusal(doubled);
  for (const Surface& surface : {Surface(folded), doubled}) {
    lawful_loops(surface, field_of(surface, [](const Vec3& p) { return p.x(); }), 0.6);
    EXPECT_NEAR(superlevel_area(surface, Field::Ones(surface.vertex_count()), 0.5), surface.area(),
                1e-14);
  }
}

// There are no periodic charts, so nothing is cut at a seam: a loop around a tube is one loop, and
// a region needs a flat surface.
TEST(LevelSetCatalogue, B17_ALoopAroundATubeHasNoSeam) {
  const Surface tube(zoo::cylinder_mesh(1.0, 2.0, 12, 5));
  const std::vector<LevelLoop> around =
      lawful_loops(tube, field_of(tube, [](const Vec3& p) { return p.z(); }), 0.9);
  ASSERT_EQ(around.size(), 2u);  // and the upper border
  for (const LevelLoop& loop : around) EXPECT_GT(length_of(tube, loop), 6.0);
  const Surface ring = torus();
  EXPECT_EQ(lawful_loops(ring, field_of(ring, [](const Vec3& p) { return p.x(); }), 0.1).size(),
            2u);
  EXPECT_NE(refusal(tube).find("2 border loops"), std::string::npos);
}

}  // namespace
}  // namespace palpation
