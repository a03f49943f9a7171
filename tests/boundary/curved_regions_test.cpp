// Areas and errors on tissue that its chart stretches.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/zoo.h"
#include "palpation/boundary/level_set.h"
#include "palpation/boundary/region_error.h"
#include "palpation/geometry/distance.h"

namespace palpation {
namespace {

constexpr double kRadius = 0.8;

/// The jittered unit square bent up to a part of a sphere.
Surface dome(int cells) {
  TriangleMesh mesh = zoo::jittered_square_mesh(cells, 3);
  for (auto vertex : mesh.vertices.rowwise()) {
    const double x = vertex.x() - 0.5, y = vertex.y() - 0.5, angle = std::hypot(x, y) / kRadius;
    const double share = angle > 0.0 ? std::sin(angle) / angle : 1.0;
    vertex << share * x, share * y, kRadius * std::cos(angle);
  }
  return Surface(mesh);
}

/// A sum of random waves.
Field waves(const Surface& surface, std::uint64_t seed) {
  Random random(seed);
  Field field = Field::Zero(surface.vertex_count());
  for (int wave = 0; wave < 4; ++wave) {
    const Vec3 along(9.0 * random.normal(), 9.0 * random.normal(), 3.0 * random.normal());
    const double phase = 6.0 * random.uniform();
    for (int v = 0; v < surface.vertex_count(); ++v)
      field[v] += std::sin(along.dot(surface.vertex(v)) + phase);
  }
  return field;
}

/// Distance over the sphere from its top, negative.
Field depth_below_top(const Surface& surface) {
  Field field(surface.vertex_count());
  for (int v = 0; v < surface.vertex_count(); ++v)
    field[v] = -kRadius * std::atan2(surface.vertex(v).head<2>().norm(), surface.vertex(v).z());
  return field;
}

TEST(CurvedRegion, HasTheAreaOfItsTriangles) {
  const Surface surface = dome(14);
  ASSERT_FALSE(surface.chart().isometric);
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Field field = waves(surface, seed);
    for (const double level : {-1.0, 0.0, 0.7}) {
      const Region region = superlevel_region(surface, field, level);
      EXPECT_NEAR(surface_area(surface, region), superlevel_area(surface, field, level),
                  1e-13 * 200);  // rounding, 392 faces
    }
  }
  EXPECT_NEAR(
      surface_area(surface, superlevel_region(surface, Field::Zero(surface.vertex_count()), 0.0)),
      surface.area(), 1e-13);
  EXPECT_EQ(surface_area(surface, Region()), 0.0);
}

// Vertices exactly at the level: rings run along edges of the mesh.
TEST(CurvedRegion, HasTheAreaOfItsTrianglesWhereItsBoundaryRunsAlongEdges) {
  const Surface surface = dome(8);
  Field field(surface.vertex_count());
  for (int v = 0; v < surface.vertex_count(); ++v)
    field[v] = v % 9 < 4 ? 0.0 : (v % 9 == 4 ? 1.0 : 2.0);
  const Region region = superlevel_region(surface, field, 1.0);
  EXPECT_NEAR(surface_area(surface, region), superlevel_area(surface, field, 1.0), 1e-13);
}

TEST(CurvedRegion, CountsNothingBesideTheTissue) {
  const Surface surface = dome(6);
  const std::array everything{PolygonWithHoles{{{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}, {}}};
  EXPECT_NEAR(surface_area(surface, Region(everything)), surface.area(), 1e-13);
}

TEST(CurvedRegionError, AddsUpToTheAreasOnTheTissue) {
  const Surface surface = dome(12);
  const Region a = superlevel_region(surface, waves(surface, 1), 0.3),
               b = superlevel_region(surface, waves(surface, 2), 0.1);
  const RegionError error = compare(surface, a, b);
  EXPECT_NEAR(error.missed_m2 - error.extra_m2, surface_area(surface, b) - surface_area(surface, a),
              1e-12);
  const double both = surface_area(surface, intersect(a, b));
  EXPECT_NEAR(error.dice, 2.0 * both / (surface_area(surface, a) + surface_area(surface, b)),
              1e-12);
}

TEST(CurvedRegionError, IsTheSameByPolygonsAndFaceByFace) {
  for (const Surface& surface : {dome(12), zoo::jittered_square(12, 4)}) {
    for (const std::uint64_t seed : {1, 5, 9}) {
      const Superlevel a{waves(surface, seed), 0.2}, b{waves(surface, seed + 1), -0.1};
      const RegionError by_polygons = compare(surface, superlevel_region(surface, a.field, a.level),
                                              superlevel_region(surface, b.field, b.level));
      const RegionError by_faces = compare(surface, a, b);
      EXPECT_NEAR(by_faces.missed_m2, by_polygons.missed_m2, 1e-12);
      EXPECT_NEAR(by_faces.extra_m2, by_polygons.extra_m2, 1e-12);
      EXPECT_NEAR(by_faces.dice, by_polygons.dice, 1e-11);
    }
  }
}

TEST(SuperlevelError, NeedsNoChart) {
  const Surface ball(zoo::icosphere_mesh(2));
  const Field height = ball.mesh().vertices.col(2), side = ball.mesh().vertices.col(0);
  const RegionError error = compare(ball, {height, 0.1}, {side, -0.2});
  EXPECT_NEAR(error.extra_m2 - error.missed_m2,
              superlevel_area(ball, height, 0.1) - superlevel_area(ball, side, -0.2), 1e-13);
  EXPECT_GT(error.dice, 0.4);
  const RegionError same = compare(ball, {height, 0.1}, {height, 0.1});
  EXPECT_NEAR(same.symmetric_difference_m2, 0.0, 1e-15);  // rounding
  EXPECT_NEAR(same.dice, 1.0, 1e-15);
  EXPECT_EQ(compare(ball, {height, 5.0}, {side, 5.0}).dice, 1.0) << "both are empty";
  const Field level = Field::Constant(ball.vertex_count(), 1.0);
  EXPECT_EQ(compare(ball, {level, 1.0}, {level, 1.0}).symmetric_difference_m2, 0.0)
      << "all of it is at the level, thus inside";
}

// Two caps around the top of the dome, their borders 0.1 apart along every meridian.
TEST(CurvedRegionError, MeasuresDistancesAlongTheSurface) {
  const Surface surface = dome(40);
  EXPECT_GT(surface.chart().distortion.greatest_stretch, 1.05);
  const Field depth = depth_below_top(surface);
  const RegionError error = compare(surface, superlevel_region(surface, depth, -0.35),
                                    superlevel_region(surface, depth, -0.25));
  // Edges are 0.025 to 0.06 long: boundaries are chords, off their circles by up to 0.06^2 / (8 x
  // 0.25).
  EXPECT_NEAR(error.mean_distance_m.value(), 0.1, 5e-4);
  EXPECT_NEAR(error.hausdorff_m.value(), 0.1, 3e-3);
  // In the chart itself it is more than 2 % off somewhere.
  const double sphere_ring = 2.0 * std::numbers::pi * kRadius * kRadius *
                             (std::cos(0.25 / kRadius) - std::cos(0.35 / kRadius));
  EXPECT_NEAR(error.extra_m2, sphere_ring, 2e-3 * sphere_ring);
  EXPECT_EQ(error.missed_m2, 0.0);
}

// The slow twin: exact geodesics from the corners of one boundary to the vertices of the mesh,
// where the other boundary runs along vertices.
TEST(CurvedRegionError, AgreesWithExactGeodesics) {
  const Surface surface = dome(16);
  const int columns = 17;
  Field left(surface.vertex_count()), patch(surface.vertex_count());
  for (int v = 0; v < surface.vertex_count(); ++v) {
    left[v] = v % columns <= 3 ? 1.0 : 0.0;
    patch[v] = v % columns <= 7 ? 1.0 : 0.0;
  }
  // At level 1 the boundaries run along the columns 3 and 7 of vertices, and along the tissue's
  // border.
  const RegionError error = compare(surface, superlevel_region(surface, left, 1.0),
                                    superlevel_region(surface, patch, 1.0));
  std::vector<SurfacePoint> boundary;
  for (int v = 0; v < surface.vertex_count(); ++v) {
    const int column = v % columns, row = v / columns;
    if (column <= 3 && (column == 0 || column == 3 || row == 0 || row == 16))
      boundary.push_back(surface.at_vertex(v));
  }
  const Field distance = distance_from(surface, boundary);
  double greatest = 0.0;
  for (int v = 0; v < surface.vertex_count(); ++v) {
    if (v % columns == 7) greatest = std::max(greatest, distance[v]);
  }
  EXPECT_NEAR(error.hausdorff_m.value(), greatest,
              0.01 * greatest);  // the nearest place may lie between vertices, which is nearer
}

}  // namespace
}  // namespace palpation
