#include "readings/readings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "readings/tissue.h"

namespace palpation {
namespace {

TEST(Readings, ThatAreSetAsideDoNotCount) {
  const Surface surface = plane(11, 21);
  std::vector<Palpation> palpations = {touch(surface, 0, 1.0), touch(surface, 1, 99.0),
                                       touch(surface, 2, 3.0)};
  palpations[1].set_aside = "jam";
  EXPECT_EQ(used_readings(palpations), (std::vector<double>{1.0, 3.0}));
  const PlacedReadings placed = placed_readings(surface, palpations);
  EXPECT_EQ(placed.readings, Eigen::Vector2d(1.0, 3.0));
  EXPECT_EQ(placed.places.row(1).transpose(), surface.vertex(2));
  EXPECT_TRUE(used_readings({}).empty());
}

TEST(Spread, IsThatOfAllReadingsAndExactlyZeroWhereAllAreAlike) {
  EXPECT_DOUBLE_EQ(spread_of(std::vector{1.0, 3.0}).mean, 2.0);
  EXPECT_DOUBLE_EQ(spread_of(std::vector{1.0, 3.0}).sd, 1.0);
  EXPECT_NEAR(spread_of(std::vector{1e12 + 1.0, 1e12 + 3.0}).sd, 1.0, 1e-12);
  EXPECT_EQ(spread_of(std::vector{0.1, 0.1, 0.1}).sd, 0.0);
}

TEST(Plane, ExplainsAllOfATiltThreeQuartersOfHalvesAndNothingOfFewReadings) {
  const Surface surface = plane(11, 21);
  const double middle = 0.5 * surface.vertex(surface.vertex_count() - 1).y();
  std::vector<Palpation> tilted, halves;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    const Vec3 at = surface.vertex(vertex);
    tilted.push_back(touch(surface, vertex, 5.0 + 300.0 * at.x() - 100.0 * at.y()));
    halves.push_back(touch(surface, vertex, at.y() > middle ? 1.0 : 0.0));
  }
  EXPECT_NEAR(explained_by_plane(surface, tilted), 1.0, 1e-12);
  EXPECT_NEAR(explained_by_plane(surface, halves), 0.75, 0.05);
  EXPECT_EQ(explained_by_plane(surface, std::span(tilted).first(14)), 0.0);
}

}  // namespace
}  // namespace palpation
