#include "palpation/world/random_shape.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "palpation/base/error.h"
#include "palpation/boundary/region.h"
#include "world/tissue.h"

namespace palpation {
namespace {

constexpr std::array kFamilies = {ShapeFamily::Star, ShapeFamily::Bent};

Outline polygon_on_circle(double radius_m, int corners) {
  Outline outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    outline.points_m.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle), 0.0);
  }
  return outline;
}

Region region_of(const Outline& outline) {
  PolygonWithHoles polygon;
  for (const Vec3& point : outline.points_m) polygon.outer.emplace_back(point.head<2>());
  return Region(std::vector{polygon});
}

// A circle of 5 mm has the reach 5 mm, and a regular polygon of 360 corners its area and length to
// 1e-4.
TEST(OutlineMeasures, AreThoseOfACircle) {
  const Outline circle = polygon_on_circle(0.005, 360);
  EXPECT_NEAR(reach(circle), 0.005, 1e-12);
  EXPECT_NEAR(signed_area(circle), std::numbers::pi * 25e-6, 1e-8);
  EXPECT_NEAR(perimeter(circle), 2.0 * std::numbers::pi * 0.005, 1e-6);
}

// Two long sides 2 mm apart: a ball of more than 1 mm does not fit between them.
TEST(OutlineMeasures, ReachTellsOfNecksToo) {
  Outline strip;
  for (int i = 0; i <= 20; ++i) strip.points_m.emplace_back(0.0005 * i, 0.0, 0.0);
  for (int i = 20; i >= 0; --i) strip.points_m.emplace_back(0.0005 * i, 0.002, 0.0);
  EXPECT_LE(reach(strip), 0.001 + 1e-12);
}

TEST(RandomShape, IsSoundForEverySeed) {
  const RandomShapeOptions options;
  for (const ShapeFamily family : kFamilies) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      Random random(seed);
      const Outline shape = random_shape(family, random);
      const double area = signed_area(shape);
      EXPECT_GE(area, options.least_area_m2 - 1e-15);
      EXPECT_LE(area, options.most_area_m2 + 1e-15);
      EXPECT_NEAR(region_of(shape).area(), area, 1e-15) << "crosses itself";
      EXPECT_GE(reach(shape), options.least_reach_m * (1.0 - 1e-9));
      for (std::size_t i = 0; i < shape.points_m.size(); ++i) {
        const Vec3& point = shape.points_m[i];
        EXPECT_TRUE(point.x() >= 0.002 - 1e-12 && point.x() <= 0.052 + 1e-12 &&
                    point.y() >= 0.002 - 1e-12 && point.y() <= 0.047 + 1e-12);
        EXPECT_LE((shape.points_m[(i + 1) % shape.points_m.size()] - point).norm(), 0.0010);
      }
    }
  }
}

TEST(RandomShape, IsTheSameForTheSameSeedOnly) {
  for (const ShapeFamily family : kFamilies) {
    Random first(7), again(7), other(8);
    const Outline shape = random_shape(family, first);
    EXPECT_EQ(shape.points_m, random_shape(family, again).points_m);
    EXPECT_NE(shape.points_m, random_shape(family, other).points_m);
  }
}

// A convex outline fills its hull; bent ones must leave a good part of theirs, on average.
TEST(RandomShape, BentOnesAreBent) {
  double hollow = 0.0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    const Outline shape = random_shape(ShapeFamily::Bent, random);
    const double round = perimeter(shape) * perimeter(shape) /
                         (4.0 * std::numbers::pi);  // the area of a circle as long as the outline
    hollow += 1.0 - signed_area(shape) / round;
  }
  EXPECT_GT(hollow / 40.0, 0.3);
}

TEST(RandomShape, RefusesWhatCannotBe) {
  Random random(1);
  EXPECT_THROW(random_shape(ShapeFamily::Star, random, {.margin_m = 0.03}), InvalidInput);
  EXPECT_THROW(random_shape(ShapeFamily::Star, random, {.least_area_m2 = 5e-4}), InvalidInput);
  EXPECT_THROW(random_shape(ShapeFamily::Star, random, {.most_area_m2 = 1e-2}), InvalidInput);
  EXPECT_THROW(random_shape(ShapeFamily::Star, random, {.least_reach_m = 0.02}), InvalidInput);
}

}  // namespace
}  // namespace palpation
