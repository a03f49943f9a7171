#include "palpation/geometry/path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

#include "geometry/zoo.h"
#include "palpation/base/error.h"
#include "palpation/base/random.h"
#include "palpation/geometry/distance.h"
#include "palpation/geometry/make_phantom.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/geometry/sampling.h"

namespace palpation {
namespace {

TEST(WayBetween, IsTheStraightLineOnFlatTissue) {
  Random random(1);
  const Surface tissue(make_plane({.columns = 26, .rows = 51, .jitter = 0.4}, random));
  for (int trial = 0; trial < 200; ++trial) {
    const std::vector<SurfacePoint> ends =
        trial % 2 == 0 ? sample_uniformly(tissue, 2, random)
                       : std::vector{tissue.at_vertex(random.below(tissue.vertex_count())),
                                     tissue.at_vertex(random.below(tissue.vertex_count()))};
    const Vec3 from = tissue.position(ends[0]);
    const Vec3 to = tissue.position(ends[1]);
    const std::vector<SurfacePoint> way = way_between(tissue, ends[0], ends[1], 0.001);
    ASSERT_EQ(way.size(), static_cast<std::size_t>(
                              std::max(0.0, std::ceil((to - from).norm() / 0.001 - 1e-6) - 1.0)));
    for (std::size_t i = 0; i < way.size(); ++i) {
      const Vec3 expected = from + (to - from).normalized() * (0.001 * static_cast<double>(i + 1));
      EXPECT_NEAR((tissue.position(way[i]) - expected).norm(), 0.0,
                  1e-9);  // a billionth of a metre: rounding over some dozen faces
      EXPECT_GE(way[i].barycentric.minCoeff(), -1e-12);
    }
  }
  EXPECT_TRUE(tissue.computed().empty());
}

TEST(WayBetween, RunsAlongEdgesAndBordersWithoutLeavingTheTissue) {
  Random random(1);
  const Surface tissue(make_plane({.columns = 26, .rows = 51}, random));
  for (const auto& [from, to] : {std::pair{0, 25},
                                 {25, 0},
                                 {0, 1300},
                                 {1300, 0},
                                 {1325, 25},
                                 {25, 1325},
                                 {1325, 1300},
                                 {26, 51},
                                 {0, 675},
                                 {675, 0}}) {
    const std::vector<SurfacePoint> way =
        way_between(tissue, tissue.at_vertex(from), tissue.at_vertex(to), 0.0005);
    const double length = (tissue.vertex(from) - tissue.vertex(to)).norm();
    EXPECT_EQ(way.size(), static_cast<std::size_t>(std::ceil(length / 0.0005 - 1e-6) - 1.0))
        << from << " to " << to;
  }
  EXPECT_TRUE(tissue.computed().empty());
}

TEST(WayBetween, IsEmptyBetweenNeighbours) {
  Random random(1);
  const Surface tissue(make_plane({.columns = 26, .rows = 51}, random));
  EXPECT_TRUE(way_between(tissue, tissue.at_vertex(3), tissue.at_vertex(3), 0.001).empty());
  EXPECT_TRUE(way_between(tissue, tissue.at_vertex(3), tissue.at_vertex(4), 0.0015).empty());
  EXPECT_THROW(way_between(tissue, tissue.at_vertex(3), tissue.at_vertex(4), 0.0), InvalidInput);
}

TEST(WayBetween, IsTheShortestPathOnCurvedTissueAndNeverJumps) {
  constexpr double kStep_m = 0.0005;
  for (const Sheet& sheet :
       {cylinder_sheet(), dome_sheet(), saddle_sheet(), wave_sheet(), folded_sheet()}) {
    Random random(1);
    const PhantomMesh phantom = make_phantom(sheet, 0.001, 0.3, random);
    const Surface tissue(phantom.mesh);
    for (int trial = 0; trial < 20; ++trial) {
      const std::vector<SurfacePoint> ends = sample_uniformly(tissue, 2, random);
      const int last = random.below(tissue.vertex_count());
      const SurfacePoint to = tissue.at_vertex(last);
      const std::vector<SurfacePoint> way = way_between(tissue, ends[0], to, kStep_m);
      const double length = distance_from(tissue, std::span(ends).first(1))[last];
      EXPECT_EQ(way.size(),
                static_cast<std::size_t>(std::max(0.0, std::ceil(length / kStep_m - 1e-6) - 1.0)));
      const auto parameters = [&](const SurfacePoint& place) {
        Vec2 p = Vec2::Zero();
        for (int i = 0; i < 3; ++i)
          p += place.barycentric[i] *
               phantom.parameters.row(tissue.triangle(place.face)[i]).transpose();
        return p;
      };
      SurfacePoint previous = ends[0];
      for (const SurfacePoint& place : way) {
        EXPECT_GE(place.barycentric.minCoeff(), 0.0);
        // Along the sheet, too: parameters are lengths but for the dome's and the saddle's, which
        // stretch by less than two.
        EXPECT_LT((parameters(place) - parameters(previous)).norm(), 2.0 * kStep_m);
        EXPECT_LE((tissue.position(place) - tissue.position(previous)).norm(),
                  kStep_m * (1.0 + 1e-9));
        previous = place;
      }
    }
  }
}

TEST(WayBetween, GoesRoundTheFoldBetweenFacingPlaces) {
  Random random(1);
  const Surface folded(make_phantom(folded_sheet(), 0.001, 0.3, random).mesh);
  const int below = folded.nearest_vertex(Vec3(0.005, 0.012, 0.0)),
            above = folded.nearest_vertex(Vec3(0.005, 0.012, 0.0015));
  // 15 mm to the bend, 2.4 mm round it, 15 mm back: also in steps that are longer than the gap.
  EXPECT_NEAR(
      static_cast<double>(
          way_between(folded, folded.at_vertex(below), folded.at_vertex(above), 0.002).size()),
      16.0, 1.0);
}

TEST(WayBetween, GoesRoundAHoleInFlatTissue) {
  Random random(1);
  TriangleMesh plane = make_plane({.size_m = Vec2(0.01, 0.01), .columns = 11, .rows = 11}, random);
  std::vector<Eigen::Vector3i> kept;
  for (const auto& corners : plane.triangles.rowwise()) {
    const Vec3 middle = (plane.vertices.row(corners[0]) + plane.vertices.row(corners[1]) +
                         plane.vertices.row(corners[2])) /
                        3.0;
    if ((middle.head<2>() - Vec2(0.005, 0.005)).cwiseAbs().maxCoeff() > 0.002)
      kept.push_back(corners.transpose());
  }
  // The hole is the square from 3 to 7 mm; the vertices inside it go.
  std::vector<int> number(static_cast<std::size_t>(plane.vertices.rows()), -1);
  TriangleMesh holed;
  holed.triangles.resize(static_cast<Eigen::Index>(kept.size()), 3);
  std::vector<Vec3> vertices;
  for (std::size_t f = 0; f < kept.size(); ++f) {
    for (int i = 0; i < 3; ++i) {
      int& n = number[static_cast<std::size_t>(kept[f][i])];
      if (n < 0) {
        n = static_cast<int>(vertices.size());
        vertices.push_back(plane.vertices.row(kept[f][i]));
      }
      holed.triangles(static_cast<Eigen::Index>(f), i) = n;
    }
  }
  holed.vertices.resize(static_cast<Eigen::Index>(vertices.size()), 3);
  for (std::size_t v = 0; v < vertices.size(); ++v)
    holed.vertices.row(static_cast<Eigen::Index>(v)) = vertices[v];
  const Surface tissue(holed);
  const SurfacePoint from = tissue.at_vertex(tissue.nearest_vertex(Vec3(0.002, 0.005, 0.0))),
                     to = tissue.at_vertex(tissue.nearest_vertex(Vec3(0.008, 0.005, 0.0)));
  // From (2, 5) by (3, 3) and (7, 3) to (8, 5), or above: 4 + 2 sqrt 5 = 8.47 mm.
  EXPECT_EQ(way_between(tissue, from, to, 0.001).size(), 8u);
}

}  // namespace
}  // namespace palpation
