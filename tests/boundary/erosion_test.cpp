#include "boundary/erosion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpation/base/error.h"
#include "palpation/base/random.h"
#include "palpation/boundary/level_set.h"
#include "palpation/boundary/region_error.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

Surface square(int cells, double jitter = 0.0) {
  Random random(3);
  return Surface(make_plane(
      {.size_m = {0.020, 0.020}, .columns = cells + 1, .rows = cells + 1, .jitter = jitter},
      random));
}

Field field_of(const Surface& surface, double (*value)(const Vec3&)) {
  Field field(surface.vertex_count());
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex)
    field[vertex] = value(surface.vertex(vertex));
  return field;
}

// A slope: the least value within 2 mm lies 2 mm down it.
TEST(Eroded, MovesALevelInwardsByTheRadius) {
  const Surface tissue = square(40);
  const Field slope = field_of(tissue, [](const Vec3& p) { return 100.0 * p.x(); });
  const Field less = eroded(tissue, slope, 0.002).field;
  for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex) {
    const double x = tissue.vertex(vertex).x();
    EXPECT_NEAR(less[vertex], 100.0 * std::max(0.0, x - 0.002), 1e-12)
        << x;  // the border is no edge
  }
}

TEST(Eroded, ADiskBecomesASmallerDisk) {
  const Surface tissue = square(80);
  const Field cone =
      field_of(tissue, [](const Vec3& p) { return 0.008 - (p - Vec3(0.010, 0.010, 0.0)).norm(); });
  const double area = superlevel_region(tissue, eroded(tissue, cone, 0.00225).field, 0.0).area();
  const double radius_m = 0.008 - 0.00225;
  EXPECT_NEAR(area, 3.14159265 * radius_m * radius_m,
              0.3e-6);  // 36 mm round, a fortieth of a cell of 0.25 mm
}

TEST(Eroded, WhatIsNarrowerThanTheTipVanishes) {
  const Surface tissue = square(40);
  const Field ridge =
      field_of(tissue, [](const Vec3& p) { return 0.002 - std::abs(p.x() - 0.010); });
  EXPECT_EQ(superlevel_region(tissue, eroded(tissue, ridge, 0.0021).field, 0.0).area(), 0.0);
  EXPECT_GT(superlevel_region(tissue, eroded(tissue, ridge, 0.0015).field, 0.0).area(), 0.0);
}

// The least of all vertices in reach, one by one: the edges that cross the sphere may only go below
// by what they change in one cell.
TEST(Eroded, IsTheLeastValueInTheBall) {
  const Surface tissue = square(20, 0.3);
  Random random(1);
  Field field(tissue.vertex_count());
  for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex) field[vertex] = random.normal();
  const Eroded less = eroded(tissue, field, 0.003);
  for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex) {
    double inside = std::numeric_limits<double>::infinity(), beyond = inside;
    for (int other = 0; other < tissue.vertex_count(); ++other) {
      const double far_m = (tissue.vertex(other) - tissue.vertex(vertex)).norm();
      if (far_m <= 0.003) inside = std::min(inside, field[other]);
      if (far_m <= 0.003 + 0.0024)
        beyond = std::min(beyond, field[other]);  // a cell's diagonal, jittered
    }
    EXPECT_LE(less.field[vertex], inside);
    EXPECT_GE(less.field[vertex], beyond);
    EXPECT_LE((tissue.vertex(less.from[vertex]) - tissue.vertex(vertex)).norm(), 0.003 + 0.0024);
  }
}

TEST(Eroded, WithoutARadiusIsTheFieldItself) {
  const Surface tissue = square(5);
  const Field field = field_of(tissue, [](const Vec3& p) { return p.x() * p.y(); });
  EXPECT_TRUE(eroded(tissue, field, 0.0).field == field);
  EXPECT_THROW(eroded(tissue, field, -0.001), InvalidInput);
  EXPECT_THROW(eroded(tissue, field.head(3), 0.001), InvalidInput);
}

}  // namespace
}  // namespace palpation
