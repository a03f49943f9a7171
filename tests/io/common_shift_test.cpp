#include "io/common_shift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "io/square.h"
#include "palpation/base/random.h"
#include "palpation/geometry/make_phantom.h"

namespace palpation {
namespace {

/// Of a hundred places, each as high above the surface as `height_m` says, and shifted.
std::optional<CommonShift> found_on(const Surface& surface, const Vec3& shift_m,
                                    const std::function<double(const Vec3&)>& height_m) {
  Random random(3);
  std::vector<Vec3> positions;
  std::vector<SurfacePoint> places;
  for (int i = 0; i < 100; ++i) {
    const auto face = static_cast<int>(random.uniform() * surface.face_count());
    const SurfacePoint made{face, Vec3::Constant(1.0 / 3.0)};
    const Vec3 here = surface.position(made);
    positions.push_back(here + height_m(here) * surface.normal(made) + shift_m);
    places.push_back(surface.project(positions.back()));
  }
  return common_shift(surface, positions, places);
}

Surface dome() {
  Random random(1);
  return Surface(make_phantom(dome_sheet(), 0.001, 0.2, random).mesh);
}

double touching(const Vec3&) { return 0.0; }

TEST(CommonShift, IsToldByHowHighPositionsLieAboveADome) {
  const Vec3 shift_m(0.003, -0.001, 0.0);
  const std::optional<CommonShift> found = found_on(dome(), shift_m, touching);
  ASSERT_TRUE(found);
  // Across the dome; along its axis the height that all have in common says less.
  EXPECT_LT((found->shift_m - shift_m).head<2>().norm(), 0.0003);
  EXPECT_LT(found->sd_m, 0.0003);
  EXPECT_NE(shift_words("felt.csv", *found).find("(0.003, -0.001, "), std::string::npos)
      << shift_words("felt.csv", *found);
}

TEST(CommonShift, IsNotHowDeepAProbeGoesIn) {
  EXPECT_FALSE(found_on(dome(), Vec3::Zero(), touching));
  EXPECT_FALSE(found_on(dome(), Vec3::Zero(), [](const Vec3&) { return -0.002; }));
  EXPECT_FALSE(found_on(dome(), Vec3::Zero(), [](const Vec3& here) {
    return here.x() > 0.010 ? -0.0005 : -0.0015;  // less deep where it is stiff
  }));
}

TEST(CommonShift, IsNotToldOnAPlane) {
  EXPECT_FALSE(found_on(square(), Vec3(0.0, 0.0, 0.002), touching));
}

}  // namespace
}  // namespace palpation
