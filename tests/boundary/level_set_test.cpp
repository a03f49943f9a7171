#include "palpation/boundary/level_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "boundary/meshes.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

using testing::fan;
using testing::field_of;
using testing::octahedron;
using testing::rough_field;
using testing::smooth_field;
using testing::square_ring;
using testing::stepped_field;
using testing::unit_square;

/// Area that a loop in the plane z = 0 encloses, positive if it runs counter-clockwise.
double enclosed(const Surface& surface, const LevelLoop& loop) {
  double doubled = 0.0;
  Vec3 last = surface.position(loop.points.back());
  for (const SurfacePoint& point : loop.points) {
    const Vec3 here = surface.position(point);
    doubled += last.x() * here.y() - here.x() * last.y();
    last = here;
  }
  return 0.5 * doubled;
}

/// Vertices with a weight at the point.
std::set<int> support(const Surface& surface, const SurfacePoint& point) {
  std::set<int> vertices;
  for (int corner = 0; corner < 3; ++corner) {
    if (point.barycentric[corner] > 0.0) vertices.insert(surface.triangle(point.face)[corner]);
  }
  return vertices;
}

bool share_a_face(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
  std::set<int> wanted = support(surface, a);
  wanted.merge(support(surface, b));
  for (int face = 0; face < surface.face_count(); ++face) {
    const Eigen::Vector3i triangle = surface.triangle(face);
    const std::set<int> corners(triangle.data(), triangle.data() + 3);
    if (std::includes(corners.begin(), corners.end(), wanted.begin(), wanted.end())) return true;
  }
  return false;
}

/// Length of the level line by marching over the triangles, sharing nothing with the library: each
/// crossed triangle gives one piece.
double marched_length(const Surface& surface, const Field& field, double level) {
  double sum = 0.0;
  for (int face = 0; face < surface.face_count(); ++face) {
    std::vector<Vec3> cuts;
    for (int corner = 0; corner < 3; ++corner) {
      const int a = surface.triangle(face)[corner];
      const int b = surface.triangle(face)[(corner + 1) % 3];
      if ((field[a] >= level) == (field[b] >= level)) continue;
      const double part = (level - field[a]) / (field[b] - field[a]);
      cuts.push_back((1.0 - part) * surface.vertex(a) + part * surface.vertex(b));
    }
    if (cuts.size() == 2) sum += (cuts[1] - cuts[0]).norm();
  }
  return sum;
}

double inner_length(const Surface& surface, const std::vector<LevelLoop>& loops) {
  double sum = 0.0;
  for (const LevelLoop& loop : loops) {
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      const Vec3 step = surface.position(loop.points[(i + 1) % loop.points.size()]) -
                        surface.position(loop.points[i]);
      if (!loop.on_border[i]) sum += step.norm();
    }
  }
  return sum;
}

std::string refusal(const Surface& surface, const Field& field, double level) {
  try {
    level_loops(surface, field, level);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

TEST(SuperlevelRegion, TakesTheTissueOnTheHighSide) {
  const Surface square = unit_square(9);
  const Region stiff =
      superlevel_region(square, field_of(square, [](const Vec3& p) { return p.x(); }), 0.75);
  EXPECT_NEAR(stiff.area(), 0.25, 1e-12);
  EXPECT_TRUE(stiff.contains({0.9, 0.5}));
}

TEST(SuperlevelRegion, KeepsTheHolesOfTheTissue) {
  const Surface ring = square_ring();
  const Region whole = superlevel_region(ring, Field::Ones(ring.vertex_count()), 0.5);
  ASSERT_EQ(whole.polygons().size(), 1u);
  EXPECT_EQ(whole.polygons()[0].holes.size(), 1u);
  EXPECT_NEAR(whole.area(), 8.0 / 9.0, 1e-15);
  // Left of x = 1/2: the line meets both borders.
  const Region left =
      superlevel_region(ring, field_of(ring, [](const Vec3& p) { return -p.x(); }), -0.5);
  EXPECT_NEAR(left.area(), 4.0 / 9.0, 1e-15);
}

// Area of a disk of radius 0.3 from a field that is linear between vertices: the chord is off by a
// second-order term.
TEST(SuperlevelRegion, OfADiskConvergesWithTheSquareOfTheCellSize) {
  const double exact_area = std::numbers::pi * 0.09;
  double coarsest = 0.0;
  for (const int cells : {20, 40, 80, 160}) {
    const Surface square = unit_square(cells, 0.2, 7);
    const Field field = field_of(
        square, [](const Vec3& p) { return 0.3 - std::hypot(p.x() - 0.51, p.y() - 0.47); });
    const double error = std::abs(superlevel_region(square, field, 0.0).area() - exact_area);
    if (cells == 20) coarsest = error;
    // Four times less at each halving; a fifth of slack for where the cells happen to lie.
    EXPECT_LT(error, 1.2 * coarsest * std::pow(20.0 / cells, 2)) << cells;
    EXPECT_LT(error, 1.0 / (cells * cells)) << cells;
  }
}

// Both areas are sums of the same triangles' parts, rounded differently: about a thousand terms of
// at most 1e-3, each to 1e-16.
TEST(SuperlevelRegion, HasTheAreaOfItsTrianglesForAnyField) {
  Random random(3);
  for (int trial = 0; trial < 24; ++trial) {
    const Surface square = unit_square(12 + trial, 0.4, 100 + trial);
    for (const Field& field : {smooth_field(square, random), rough_field(square, random),
                               stepped_field(square, random)}) {
      for (const double level : {-0.7, 0.0, 1.0}) {
        const Region region = superlevel_region(square, field, level);
        EXPECT_NEAR(surface_area(square, region), superlevel_area(square, field, level), 1e-13)
            << "trial " << trial << ", level " << level;
      }
    }
  }
}

TEST(SuperlevelRegion, AndThatOfTheMirroredFieldShareTheTissue) {
  Random random(4);
  const Surface square = unit_square(20, 0.3);
  for (int trial = 0; trial < 10; ++trial) {
    const Field field = trial % 2 == 0 ? smooth_field(square, random) : rough_field(square, random);
    const Region above = superlevel_region(square, field, 0.25);
    const Region below = superlevel_region(square, -field, -0.25);
    // The two round the same points of the level line on their own, at most an ulp apart, along a
    // line no longer than 100.
    EXPECT_LT(intersect(above, below).area(), 1e-13);
    EXPECT_NEAR(unite(above, below).area(), 1.0, 1e-13);
  }
}

TEST(LevelLoops, RunWithTheInsideOnTheirLeft) {
  const Surface square = unit_square(40, 0.2);
  const Field field = field_of(
      square, [](const Vec3& p) { return -std::abs(std::hypot(p.x() - 0.5, p.y() - 0.5) - 0.3); });
  const std::vector<LevelLoop> loops =
      level_loops(square, field, -0.1);  // between the radii 0.2 and 0.4
  ASSERT_EQ(loops.size(), 2u);
  // Second order in a cell of 1/40.
  EXPECT_NEAR(enclosed(square, loops[0]), std::numbers::pi * 0.16, 1e-3);
  EXPECT_NEAR(enclosed(square, loops[1]), -std::numbers::pi * 0.04, 1e-3);
}

TEST(LevelLoops, AreAtTheLevelOrOnTheBorderAndStepWithinFaces) {
  Random random(8);
  const Surface square = unit_square(8, 0.4);
  for (int trial = 0; trial < 12; ++trial) {
    const Field field = trial % 3 == 0   ? smooth_field(square, random)
                        : trial % 3 == 1 ? rough_field(square, random)
                                         : stepped_field(square, random);
    const double level = trial % 3 == 2 ? 1.0 : 0.1;
    for (const LevelLoop& loop : level_loops(square, field, level)) {
      const std::size_t count = loop.points.size();
      ASSERT_EQ(loop.on_border.size(), count);
      ASSERT_GE(count, 3u);
      for (std::size_t i = 0; i < count; ++i) {
        const SurfacePoint& here = loop.points[i];
        EXPECT_TRUE(share_a_face(square, here, loop.points[(i + 1) % count]));
        EXPECT_NE(square.position(here), square.position(loop.points[(i + 1) % count]));
        EXPECT_GE(here.barycentric.minCoeff(), 0.0);
        EXPECT_NEAR(here.barycentric.sum(), 1.0, 1e-15);
        if (!loop.on_border[i]) {
          // Interpolating values below 5 costs a few of their last places.
          EXPECT_NEAR(square.interpolate(field, here), level, 1e-14);
          continue;
        }
        const Vec3 middle =
            0.5 * (square.position(here) + square.position(loop.points[(i + 1) % count]));
        EXPECT_TRUE(middle.x() == 0.0 || middle.x() == 1.0 || middle.y() == 0.0 ||
                    middle.y() == 1.0)
            << middle.transpose();
        EXPECT_GE(square.interpolate(field, here), level - 1e-14);
      }
    }
  }
}

TEST(LevelLoops, HaveTheLengthOfTheMarchedLine) {
  Random random(9);
  for (int trial = 0; trial < 10; ++trial) {
    const Surface square = unit_square(25, 0.4, 50 + trial);
    const Field field = trial % 2 == 0 ? smooth_field(square, random) : rough_field(square, random);
    // A thousand pieces, lengths below 100 in all.
    EXPECT_NEAR(inner_length(square, level_loops(square, field, 0.1)),
                marched_length(square, field, 0.1), 1e-12)
        << "trial " << trial;
  }
}

TEST(LevelLoops, OnAClosedSurfaceNeedNoBorder) {
  const Surface solid = octahedron();
  const Field height = field_of(solid, [](const Vec3& p) { return p.z(); });
  const std::vector<LevelLoop> loops = level_loops(solid, height, 0.5);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].points.size(), 4u);
  EXPECT_NEAR(enclosed(solid, loops[0]), 0.5, 1e-15);  // a square of diagonal 1, seen from above
  EXPECT_NEAR(superlevel_area(solid, height, 0.5), solid.area() / 8.0, 1e-15);
  EXPECT_TRUE(level_loops(solid, height, -2.0).empty());
  EXPECT_NEAR(superlevel_area(solid, height, -2.0), solid.area(),
              1e-14);  // eight faces, summed in two ways
}

TEST(LevelLoops, RefuseWhatIsNoFieldOfTheSurface) {
  const Surface square = unit_square(2);
  Field field = Field::Zero(9);
  EXPECT_NE(refusal(square, Field::Zero(8), 0.0).find("must have one for each of the 9 vertices"),
            std::string::npos);
  EXPECT_NE(refusal(square, field, std::numeric_limits<double>::quiet_NaN()).find("the level nan"),
            std::string::npos);
  field[4] = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal(square, field, 0.0).find("at vertex 4"), std::string::npos);
  EXPECT_THROW(superlevel_area(square, field, 0.0), InvalidInput);
  EXPECT_THROW(superlevel_region(square, field, 0.0), InvalidInput);
}

TEST(SuperlevelRegion, RefusesASurfaceWithoutAChart) {
  EXPECT_THROW(superlevel_region(octahedron(), Field::Zero(6), 0.5), InvalidInput);
}

}  // namespace
}  // namespace palpation
