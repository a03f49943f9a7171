#include "palpation/boundary/region_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "boundary/meshes.h"
#include "palpation/boundary/level_set.h"

namespace palpation {
namespace {

using testing::unit_square;

Region ring_region(Ring ring) {
  const std::array polygon{PolygonWithHoles{std::move(ring), {}}};
  return Region(polygon);
}

Region box(double x0, double y0, double x1, double y1) {
  return ring_region({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

Region disk(const Vec2& centre, double radius, int corners = 720) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    ring.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return ring_region(ring);
}

TEST(RegionError, OfTheTruthItselfIsNought) {
  const Surface tissue = unit_square(2);
  const RegionError error = compare(tissue, disk({0.5, 0.5}, 0.25), disk({0.5, 0.5}, 0.25));
  EXPECT_EQ(error.symmetric_difference_m2, 0.0);
  EXPECT_EQ(error.dice, 1.0);
  // A sample inside an edge is off it by a rounding of its coordinates.
  EXPECT_LT(error.hausdorff_m.value(), 1e-15);
  EXPECT_LT(error.mean_distance_m.value(), 1e-15);
}

TEST(RegionError, KeepsMissedAndExtraApart) {
  const Surface tissue = unit_square(2);
  const RegionError error =
      compare(tissue, box(0.25, 0.25, 0.75, 0.5), box(0.5, 0.25, 0.625, 0.75));
  EXPECT_EQ(error.extra_m2, 0.09375);   // 1/2 x 1/4 less 1/8 x 1/4
  EXPECT_EQ(error.missed_m2, 0.03125);  // 1/8 x 1/4
  EXPECT_EQ(error.symmetric_difference_m2, 0.125);
  EXPECT_EQ(error.dice, 2.0 * 0.03125 / (0.125 + 0.0625));
  const RegionError swapped =
      compare(tissue, box(0.5, 0.25, 0.625, 0.75), box(0.25, 0.25, 0.75, 0.5));
  EXPECT_EQ(swapped.missed_m2, error.extra_m2);
  EXPECT_EQ(swapped.extra_m2, error.missed_m2);
  EXPECT_EQ(swapped.hausdorff_m, error.hausdorff_m);
}

TEST(RegionError, OfRegionsApartIsBothAreas) {
  const Surface tissue = unit_square(2);
  const RegionError error = compare(tissue, box(0.0, 0.0, 0.25, 0.25), box(0.5, 0.5, 1.0, 1.0));
  EXPECT_EQ(error.missed_m2, 0.25);
  EXPECT_EQ(error.extra_m2, 0.0625);
  EXPECT_EQ(error.dice, 0.0);
  // From the far corner of the truth to the near corner of the estimate.
  EXPECT_DOUBLE_EQ(error.hausdorff_m.value(), 0.75 * std::numbers::sqrt2);
}

TEST(RegionError, WithoutAnEstimateOrATruthHasNoDistances) {
  const Surface tissue = unit_square(2);
  const RegionError missed = compare(tissue, Region(), box(0.0, 0.0, 0.5, 0.5));
  EXPECT_EQ(missed.missed_m2, 0.25);
  EXPECT_EQ(missed.extra_m2, 0.0);
  EXPECT_EQ(missed.dice, 0.0);
  EXPECT_FALSE(missed.hausdorff_m.has_value());
  EXPECT_FALSE(missed.mean_distance_m.has_value());
  const RegionError nothing = compare(tissue, Region(), Region());
  EXPECT_EQ(nothing.dice, 1.0);
  EXPECT_EQ(nothing.symmetric_difference_m2, 0.0);
  EXPECT_FALSE(nothing.hausdorff_m.has_value());
}

TEST(RegionError, BetweenConcentricDisksIsTheirRadiiApart) {
  const Surface tissue = unit_square(2);
  const RegionError error = compare(tissue, disk({0.5, 0.5}, 0.25), disk({0.5, 0.5}, 0.3));
  // Corners to corners 0.05; between chords at most 0.3 (1 - cos(pi / 720)) = 3e-6 off.
  EXPECT_NEAR(error.hausdorff_m.value(), 0.05, 3e-6);
  EXPECT_NEAR(error.mean_distance_m.value(), 0.05, 3e-6);
  EXPECT_EQ(error.extra_m2, 0.0);
}

// Two squares of side 1/2, one shifted by d along x. By symmetry the mean is that over one of them,
// of length 2. Its outer side is d from the other square. Its inner side is d from the other's
// side, but nearer to top and bottom close to the ends: there the distance grows from 0 to d. Top
// and bottom lie on the other's but for the last d, where the distance grows from 0 to d too.
TEST(RegionError, AveragesDistancesAlongBothBoundaries) {
  const Surface tissue = unit_square(2);
  const double d = 0.125;
  const RegionError error =
      compare(tissue, box(0.25, 0.25, 0.75, 0.75), box(0.25 + d, 0.25, 0.75 + d, 0.75));
  EXPECT_DOUBLE_EQ(error.hausdorff_m.value(), d);
  const double outer_side = 0.5 * d;
  const double inner_side = (0.5 - 2.0 * d) * d + d * d;
  const double along = 2.0 * (0.5 * d * d);
  // Samples lie 2 / 4000 apart or closer; each kink costs at most a quarter of that squared.
  EXPECT_NEAR(error.mean_distance_m.value(), (outer_side + inner_side + along) / 2.0, 1e-6);
}

TEST(RegionError, CountsHolesAsBoundary) {
  const Surface tissue = unit_square(2);
  const Region ring = subtract(box(0.0, 0.0, 1.0, 1.0), box(0.375, 0.375, 0.625, 0.625));
  const RegionError error = compare(tissue, box(0.0, 0.0, 1.0, 1.0), ring);
  EXPECT_EQ(error.extra_m2, 0.0625);
  EXPECT_EQ(error.missed_m2, 0.0);
  EXPECT_DOUBLE_EQ(error.hausdorff_m.value(), 0.375);  // from the hole's corner to the outer side
}

// Everything is a ratio or a length: scaled and far off, the same but for rounding at the place.
TEST(RegionError, IsTheSameAtAnyScaleAndFarFromTheOrigin) {
  const Surface tissue = unit_square(2);
  const auto at = [](double scale, const Vec2& origin) {
    return [=](double x0, double y0, double x1, double y1) {
      return box(origin.x() + scale * x0, origin.y() + scale * y0, origin.x() + scale * x1,
                 origin.y() + scale * y1);
    };
  };
  // Powers of two, so that nothing is rounded: 9e-13 m across, 5e8 m across, 1e-90 m across; and
  // 2^-10 m across at 2^29 m.
  for (const auto& [scale, origin] :
       {std::pair(std::ldexp(1.0, -40), Vec2(0, 0)), std::pair(std::ldexp(1.0, 29), Vec2(0, 0)),
        std::pair(std::ldexp(1.0, -299), Vec2(0, 0)),
        std::pair(std::ldexp(1.0, -10), Vec2(536870912, 536870912))}) {
    const auto scaled = at(scale, origin);
    const RegionError error =
        compare(tissue, scaled(0.25, 0.25, 0.75, 0.5), scaled(0.5, 0.25, 0.625, 0.75));
    EXPECT_EQ(error.extra_m2, 0.09375 * scale * scale);
    EXPECT_EQ(error.missed_m2, 0.03125 * scale * scale);
    EXPECT_EQ(error.dice, 2.0 * 0.03125 / (0.125 + 0.0625));
    EXPECT_DOUBLE_EQ(error.hausdorff_m.value(), 0.25 * scale);
    EXPECT_LT(error.mean_distance_m.value(), 0.25 * scale);
    EXPECT_GT(error.mean_distance_m.value(), 0.05 * scale);
  }
}

TEST(RegionError, OfSliversWithoutAnAreaThatDoublesCanHoldHasADice) {
  const Surface tissue = unit_square(2);
  const Region up = ring_region({{0, 0}, {1, 0}, {1, std::numeric_limits<double>::denorm_min()}});
  const Region down =
      ring_region({{0, 0}, {1, -std::numeric_limits<double>::denorm_min()}, {1, 0}});
  EXPECT_EQ(compare(tissue, up, up).dice, 1.0);
  EXPECT_EQ(compare(tissue, up, down).dice, 0.0);
  EXPECT_EQ(compare(tissue, up, down).symmetric_difference_m2, 0.0);
}

struct Edge {
  Vec2 from;
  Vec2 to;
};

std::vector<Edge> edges_of(const Region& region) {
  std::vector<Edge> edges;
  for (const PolygonWithHoles& polygon : region.polygons()) {
    std::vector<Ring> rings = polygon.holes;
    rings.push_back(polygon.outer);
    for (const Ring& ring : rings) {
      for (std::size_t i = 0; i < ring.size(); ++i)
        edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
    }
  }
  return edges;
}

double distance_to(const std::vector<Edge>& edges, const Vec2& place) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [p, q] : edges) {
    const double part = std::clamp((place - p).dot(q - p) / (q - p).squaredNorm(), 0.0, 1.0);
    least = std::min(least, (place - p - part * (q - p)).norm());
  }
  return least;
}

/// Greatest distance from samples of one boundary, in steps no longer than a millimetre, to the
/// other.
double farthest(const std::vector<Edge>& boundary, const std::vector<Edge>& other) {
  double greatest = 0.0;
  for (const auto& [p, q] : boundary) {
    const int pieces = 1 + static_cast<int>((q - p).norm() / 1e-3);
    for (int piece = 0; piece < pieces; ++piece)
      greatest = std::max(greatest, distance_to(other, p + (q - p) * piece / pieces));
  }
  return greatest;
}

TEST(RegionError, AgreesWithSearchingEverySegment) {
  const Surface tissue = unit_square(30, 0.3);
  Random random(21);
  for (int trial = 0; trial < 3; ++trial) {
    const Region a = superlevel_region(tissue, testing::smooth_field(tissue, random), 0.5);
    const Region b = superlevel_region(tissue, testing::smooth_field(tissue, random), 0.5);
    ASSERT_FALSE(a.empty());
    ASSERT_FALSE(b.empty());
    const RegionError error = compare(tissue, a, b);
    // Distance changes no faster than the place: half a step of a millimetre, and half of 20 m /
    // 4000.
    EXPECT_NEAR(error.hausdorff_m.value(),
                std::max(farthest(edges_of(a), edges_of(b)), farthest(edges_of(b), edges_of(a))),
                3e-3);
    EXPECT_NEAR(error.symmetric_difference_m2, symmetric_difference(a, b).area(),
                1e-15);  // the same number, rounded once or thrice
  }
}

}  // namespace
}  // namespace palpation
