#include "palpation/exploration/reach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "palpation/base/error.h"
#include "palpation/geometry/make_phantom.h"

namespace palpation {
namespace {

Surface phantom(const Sheet& sheet) {
  Random random(1);
  return Surface(make_phantom(sheet, 0.001, 0.3, random).mesh);
}

TEST(Reach, IsAllWhereNothingIsAsked) {
  const Surface dome = phantom(dome_sheet());
  std::vector<int> all(static_cast<std::size_t>(dome.vertex_count()));
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(reachable_vertices(dome, {}), all);
  EXPECT_TRUE(dome.computed().empty());
}

TEST(Reach, IsTheCapWhoseNormalsLieInTheCone) {
  const Surface dome = phantom(dome_sheet());
  const std::vector<int> reached =
      reachable_vertices(dome, {.shaft_direction = Vec3(0.0, 0.0, 3.0), .cone_rad = 0.5});
  std::vector<bool> is_reached(static_cast<std::size_t>(dome.vertex_count()), false);
  for (const int vertex : reached) is_reached[static_cast<std::size_t>(vertex)] = true;
  for (int vertex = 0; vertex < dome.vertex_count(); ++vertex) {
    const double angle = std::acos(1.0 + dome.vertex(vertex).z() / 0.025);
    if (std::abs(angle - 0.5) > 0.03) {
      EXPECT_EQ(is_reached[static_cast<std::size_t>(vertex)], angle < 0.5)
          << "normals are good to 1 degree";
    }
  }
}

TEST(Reach, LeavesOutWhatAFacingFlankCovers) {
  // A clearance shorter than the gap of 1.5 mm leaves all. A longer one leaves the top of the third
  // flank, the outside of the bend that it comes from, and the middle of the bend between the
  // others, which looks along the gap.
  const Surface folded = phantom(folded_sheet());
  const auto area_of = [&](double clearance_m) {
    double area = 0.0;
    for (const int vertex : reachable_vertices(folded, {.clearance_m = clearance_m}))
      area += folded.vertex_areas()[vertex];
    return area;
  };
  EXPECT_NEAR(area_of(0.001), folded.area(), 1e-9);
  EXPECT_NEAR(area_of(0.004), 0.025 * (0.020 + 0.00236 + 0.0004),
              0.025 * 0.0008);  // whole rows of vertices, 1 mm apart
  EXPECT_EQ(folded.computed(), std::vector<std::string>{"clearance"});
  for (const int vertex : reachable_vertices(folded, {.clearance_m = 0.004})) {
    const Vec3 place = folded.vertex(vertex);
    const bool looks_along_the_gap = place.x() > 0.0205 && std::abs(place.z() - 0.00075) < 0.0003;
    EXPECT_TRUE(place.z() > 0.0014 || looks_along_the_gap) << place.transpose();
  }
}

// In a wave of 2 mm over 20 mm the valleys are round with a radius of wavelength^2 / (4 pi^2
// amplitude), 5.1 mm: a probe of 4 mm has room in them, one of 12 mm has none, but on the crests.
TEST(Reach, LeavesOutValleysThatAreNarrowerThanTheProbe) {
  const Surface wave = phantom(wave_sheet());
  const auto reached = [&](double radius_m) {
    return reachable_vertices(wave, {.clearance_m = 0.010, .probe_radius_m = radius_m});
  };
  EXPECT_EQ(reached(0.0).size(), static_cast<std::size_t>(wave.vertex_count()));
  EXPECT_EQ(reached(0.004).size(), static_cast<std::size_t>(wave.vertex_count()));
  const std::vector<int> left = reached(0.012);
  EXPECT_LT(left.size(), static_cast<std::size_t>(wave.vertex_count()));
  std::vector<bool> is_left(static_cast<std::size_t>(wave.vertex_count()), false);
  for (const int vertex : left) is_left[static_cast<std::size_t>(vertex)] = true;
  for (int vertex = 0; vertex < wave.vertex_count(); ++vertex) {
    if (wave.vertex(vertex).z() > 0.001) {
      EXPECT_TRUE(is_left[static_cast<std::size_t>(vertex)]) << vertex;
    }
    const bool in_an_inner_valley =
        wave.vertex(vertex).z() < -0.0019 && std::abs(wave.vertex(vertex).y() - 0.025) < 0.015;
    if (in_an_inner_valley) {
      EXPECT_FALSE(is_left[static_cast<std::size_t>(vertex)]) << vertex;
    }
  }
}

TEST(Reach, RefusesWhatIsNoCone) {
  const Surface dome = phantom(dome_sheet());
  EXPECT_THROW(reachable_vertices(dome, {.shaft_direction = Vec3::Zero()}), InvalidInput);
  EXPECT_THROW(reachable_vertices(dome, {.cone_rad = 0.0}), InvalidInput);
  EXPECT_THROW(reachable_vertices(dome, {.clearance_m = -1.0}), InvalidInput);
  EXPECT_THROW(reachable_vertices(dome, {.clearance_m = 1.0, .probe_radius_m = -1.0}),
               InvalidInput);
}

}  // namespace
}  // namespace palpation
