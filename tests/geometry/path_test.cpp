#include "palpation/geometry/path.h"

#include <gtest/gtest.h>

#include "geometry/zoo.h"
#include "palpation/base/error.h"
#include "palpation/base/random.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/geometry/sampling.h"

namespace palpation {
namespace {

TEST(WayBetween, IsTheStraightLineOnFlatTissue) {
  Random random(1);
  const Surface tissue(make_plane({.columns = 26, .rows = 51, .jitter = 0.4}, random));
  for (int trial = 0; trial < 200; ++trial) {
    const std::vector<SurfacePoint> ends = trial % 2 == 0 ? sample_uniformly(tissue, 2, random)
                                                          : std::vector{tissue.at_vertex(random.below(tissue.vertex_count())),
                                                                        tissue.at_vertex(random.below(tissue.vertex_count()))};
    const Vec3 from = tissue.position(ends[0]);
    const Vec3 to = tissue.position(ends[1]);
    const std::vector<SurfacePoint> way = way_between(tissue, ends[0], ends[1], 0.001);
    ASSERT_EQ(way.size(), static_cast<std::size_t>(std::max(0.0, std::ceil((to - from).norm() / 0.001 - 1e-6) - 1.0)));
    for (std::size_t i = 0; i < way.size(); ++i) {
      const Vec3 expected = from + (to - from).normalized() * (0.001 * static_cast<double>(i + 1));
      EXPECT_NEAR((tissue.position(way[i]) - expected).norm(), 0.0, 1e-9);  // a billionth of a metre: rounding over some dozen faces
      EXPECT_GE(way[i].barycentric.minCoeff(), -1e-12);
    }
  }
  EXPECT_TRUE(tissue.computed().empty());
}

TEST(WayBetween, RunsAlongEdgesAndBordersWithoutLeavingTheTissue) {
  Random random(1);
  const Surface tissue(make_plane({.columns = 26, .rows = 51}, random));
  for (const auto& [from, to] :
       {std::pair{0, 25}, {25, 0}, {0, 1300}, {1300, 0}, {1325, 25}, {25, 1325}, {1325, 1300}, {26, 51}, {0, 675}, {675, 0}}) {
    const std::vector<SurfacePoint> way = way_between(tissue, tissue.at_vertex(from), tissue.at_vertex(to), 0.0005);
    const double length = (tissue.vertex(from) - tissue.vertex(to)).norm();
    EXPECT_EQ(way.size(), static_cast<std::size_t>(std::ceil(length / 0.0005 - 1e-6) - 1.0)) << from << " to " << to;
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

}  // namespace
}  // namespace palpation
