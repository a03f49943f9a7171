#include "exploration/waves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "palpation/base/random.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

constexpr double kEnough = 6.0;

Surface flat_tissue() {
  Random random(0);
  return Surface(make_plane({.size_m = {0.04, 0.05}, .columns = 21, .rows = 26}, random));
}

double saddle(const Vec3& place) {
  return 4000.0 * ((place.x() - 0.02) * (place.x() - 0.02) - std::pow(place.y() - 0.025, 2));
}

/// A corner that is stiff, on so high a saddle.
EdgeData corner_on_saddle(const Surface& surface, double height, int count) {
  Random random(4);
  EdgeData data;
  data.reading.resize(count);
  for (int i = 0; i < count; ++i) {
    const SurfacePoint place = surface.at_vertex(random.below(surface.vertex_count()));
    const Vec3 at = surface.position(place);
    data.places.push_back(place);
    data.reading[i] =
        7.0 + height * saddle(at) + (at.norm() < 0.02 ? 2.0 : 0.0) + 0.05 * random.normal();
  }
  return data;
}

/// Of the background that was found, but for a constant.
double off_saddle(const Surface& surface, const Field& found, double height) {
  Field off = found;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex)
    off[vertex] -= height * saddle(surface.vertex(vertex));
  off.array() -= off.mean();
  return off.cwiseAbs().mean();
}

TEST(WavesOfParallelSurfaces, AreFoundUnderATumourAsHighAsThey) {
  const Surface surface = flat_tissue();
  for (const double height : {-1.0, 1.0}) {
    const std::vector<Field> found = waves_of_parallel_surfaces(
        Layout(surface), corner_on_saddle(surface, height, 120), kEnough, 4);
    ASSERT_FALSE(found.empty()) << height;
    double least = 1e9;
    for (const Field& one : found) least = std::min(least, off_saddle(surface, one, height));
    EXPECT_LT(least, 0.3)
        << height;  // of 4.1 from lowest to highest: a start, which the edge mends
  }
}

TEST(WavesOfParallelSurfaces, AreNoneWhereLevelOnesExplainAsMuch) {
  const Surface surface = flat_tissue();
  EXPECT_TRUE(
      waves_of_parallel_surfaces(Layout(surface), corner_on_saddle(surface, 0.0, 120), kEnough, 4)
          .empty());
}

TEST(WavesOfParallelSurfaces, DoNotDependOnUnitOrderOrOnHowManyMoreThereAre) {
  const Surface surface = flat_tissue();
  const EdgeData here = corner_on_saddle(surface, 1.0, 500);
  EdgeData there = here;
  std::ranges::reverse(there.places);
  there.reading = 1e-6 * here.reading.reverse();
  const std::vector<Field> one = waves_of_parallel_surfaces(Layout(surface), here, kEnough, 1),
                           other = waves_of_parallel_surfaces(Layout(surface), there, kEnough, 1);
  ASSERT_EQ(one.size(), 1u);
  ASSERT_EQ(other.size(), 1u);
  EXPECT_LT((1e6 * other.front() - one.front()).norm(), 1e-4 * one.front().norm());
}

TEST(WavesOfParallelSurfaces, AreNotAskedOfFewReadingsNorOfLikeOnes) {
  const Surface surface = flat_tissue();
  EXPECT_TRUE(
      waves_of_parallel_surfaces(Layout(surface), corner_on_saddle(surface, 1.0, 14), kEnough, 4)
          .empty());
  EdgeData alike = corner_on_saddle(surface, 1.0, 60);
  alike.reading.setConstant(7.0);
  EXPECT_TRUE(waves_of_parallel_surfaces(Layout(surface), alike, kEnough, 4).empty());
}

}  // namespace
}  // namespace palpation
