#include "palpation/world/phantom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "palpation/base/error.h"
#include "world/tissue.h"

namespace palpation {
namespace {

/// Radius 6 mm around (12, 30) mm: (18, 30) mm is on its outline, and a vertex of a sheet with
/// vertices every millimetre.
const Disk kDisk{.centre_m = {0.012, 0.030, 0.0}, .radius_m = 0.006};

int vertex_at_mm(const Surface& surface, double x_mm, double y_mm) {
  return surface.nearest_vertex(Vec3(1e-3 * x_mm, 1e-3 * y_mm, 0.0));
}

double reading_at_mm(const Phantom& phantom, const Surface& surface, double x_mm, double y_mm) {
  Random random(1);
  return phantom.touch(surface.at_vertex(vertex_at_mm(surface, x_mm, y_mm)), random).reading;
}

// The paper's numbers: 7 on healthy tissue, 9 deep inside, their mean on the outline. exp(-1400 *
// 0.006) = 0.00022 is what is left 6 mm away.
TEST(Phantom, IsHalfWayBetweenLowAndHighOnTheOutline) {
  const Surface tissue = sheet(0.025, 0.050, 0.001);
  const Phantom phantom(tissue, {kDisk}, {});
  EXPECT_NEAR(phantom.truth()[vertex_at_mm(tissue, 18, 30)], 8.0,
              1e-11);  // slope times a rounding of 1e-17 m
  EXPECT_NEAR(phantom.truth()[vertex_at_mm(tissue, 12, 30)], 7.0 + 2.0 / (1.0 + std::exp(-8.4)),
              1e-11);
  EXPECT_NEAR(phantom.truth()[vertex_at_mm(tissue, 12, 18)], 7.0 + 2.0 / (1.0 + std::exp(8.4)),
              1e-11);
  EXPECT_EQ(phantom.true_level(), 8.0);
}

// At 70 % the level is 7 + 0.7 * 2 = 8.4, and the formula is shifted so that the shape itself is
// the contour there.
TEST(Phantom, HasTheShapeItselfAsContourAtAnyFraction) {
  const Surface tissue = sheet(0.025, 0.050, 0.001);
  for (const double fraction : {0.1, 0.5, 0.7}) {
    const Phantom phantom(tissue, {kDisk}, {.fraction = fraction});
    EXPECT_NEAR(phantom.true_level(), 7.0 + 2.0 * fraction, 1e-15);
    EXPECT_NEAR(phantom.truth()[vertex_at_mm(tissue, 18, 30)], 7.0 + 2.0 * fraction, 1e-11);
    EXPECT_GT(phantom.truth()[vertex_at_mm(tissue, 17, 30)], phantom.true_level());
    EXPECT_LT(phantom.truth()[vertex_at_mm(tissue, 19, 30)], phantom.true_level());
  }
}

TEST(Phantom, IsLowEverywhereWithoutTumours) {
  const Surface tissue = sheet(0.004, 0.004, 0.001);
  const Phantom phantom(tissue, {}, {});
  EXPECT_TRUE((phantom.truth().array() == 7.0).all());
  Random random(1);
  EXPECT_EQ(phantom.touch({0, Vec3(0.5, 0.25, 0.25)}, random).reading, 7.0);
  EXPECT_EQ(phantom.touch(tissue.at_vertex(3), random).reading, 7.0);
}

// Half of the range of 2 along y, the longer side: 0 at y = 0, 0.5 at y = 25 mm, 1 at y = 50 mm,
// added far from the disk; the truth is free of it.
TEST(Phantom, AddsABiasThatGrowsFromNothingAlongTheLongestSide) {
  const Surface tissue = sheet(0.025, 0.050, 0.001);
  const Phantom phantom(tissue, {}, {.bias = 0.5});
  EXPECT_NEAR(reading_at_mm(phantom, tissue, 20, 0), 7.0, 1e-14);
  EXPECT_NEAR(reading_at_mm(phantom, tissue, 3, 25), 7.5, 1e-14);
  EXPECT_NEAR(reading_at_mm(phantom, tissue, 11, 50), 8.0, 1e-14);
  EXPECT_TRUE((phantom.truth().array() == 7.0).all());
}

// Along -x, of any length: 1 at x = 0, 0 at x = 25 mm.
TEST(Phantom, TakesTheBiasAlongTheAxisThatIsGiven) {
  const Surface tissue = sheet(0.025, 0.050, 0.001);
  const Phantom phantom(tissue, {}, {.bias = 1.0, .bias_axis = {-3.0, 0.0, 0.0}});
  EXPECT_NEAR(reading_at_mm(phantom, tissue, 0, 13), 9.0, 1e-14);
  EXPECT_NEAR(reading_at_mm(phantom, tissue, 5, 40), 7.0 + 2.0 * 0.8, 1e-14);
  EXPECT_NEAR(reading_at_mm(phantom, tissue, 25, 1), 7.0, 1e-14);
}

// 20,000 readings of noise 0.1 * 2 = 0.2 at one place. Their mean has a standard deviation of 0.2 /
// sqrt(20,000) = 0.0014, their standard deviation one of 0.2 / sqrt(40,000) = 0.001; both within
// four of these: 1 seed in 8,000 would fail.
TEST(Phantom, AddsNoiseOfTheRightMeanAndSpread) {
  const Surface tissue = sheet(0.025, 0.050, 0.001);
  const Phantom phantom(tissue, {kDisk}, {.noise = 0.1});
  const SurfacePoint on_outline = tissue.at_vertex(vertex_at_mm(tissue, 18, 30));
  Random random(11);
  const int count = 20'000;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < count; ++i) {
    const double deviation = phantom.touch(on_outline, random).reading - 8.0;
    sum += deviation;
    squares += deviation * deviation;
  }
  EXPECT_NEAR(sum / count, 0.0, 4 * 0.2 / std::sqrt(20'000.0));
  EXPECT_NEAR(std::sqrt(squares / count), 0.2, 4 * 0.2 / std::sqrt(40'000.0));
}

TEST(Phantom, DrawsOneNormalForEveryTouchAtAnyNoise) {
  const Surface tissue = sheet(0.004, 0.004, 0.001);
  for (const double noise : {0.0, 0.25}) {
    const Phantom phantom(tissue, {}, {.noise = noise});
    Random touched(5), drawn(5);
    for (int i = 0; i < 3; ++i) {
      const double expected = 7.0 + noise * 2.0 * drawn.normal();
      EXPECT_EQ(phantom.touch(tissue.at_vertex(i), touched).reading, expected);
    }
    EXPECT_EQ(touched.bits(), drawn.bits());
  }
}

// In the middle of an edge from distance 3 to distance 2 mm inside a disk: 2.5 mm, though the
// disk's own distance there would be less even.
TEST(Phantom, IsLinearInTheDistanceInsideAFace) {
  const Surface tissue = sheet(0.010, 0.010, 0.001);
  const Phantom phantom(tissue, {Disk{.centre_m = {0.0, 0.0, 0.0}, .radius_m = 0.005}},
                        {.slope_per_m = 400.0});
  const int face = 0;
  const Eigen::Vector3i corners = tissue.triangle(face);
  double distance_m = 0.0;
  for (int i = 0; i < 3; ++i) distance_m += (0.005 - tissue.vertex(corners[i]).norm()) / 3.0;
  Random random(1);
  EXPECT_NEAR(phantom.touch({face, Vec3::Constant(1.0 / 3.0)}, random).reading,
              7.0 + 2.0 / (1.0 + std::exp(-400.0 * distance_m)), 1e-14);
}

TEST(Phantom, LeavesTheNoiseOfAReadingToTheField) {
  const Surface tissue = sheet(0.004, 0.004, 0.001);
  Random random(1);
  const SurfacePoint where{3, Vec3(0.5, 0.25, 0.25)};
  const Palpation palpation = Phantom(tissue, {}, {.noise = 0.1}).touch(where, random);
  EXPECT_TRUE(std::isnan(palpation.noise_variance));
  EXPECT_EQ(palpation.where.face, 3);
  EXPECT_EQ(palpation.where.barycentric, where.barycentric);
}

TEST(Phantom, RefusesModelsThatAreNone) {
  const Surface tissue = sheet(0.004, 0.004, 0.001);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<StiffnessModel> bad = {{.low = nan},
                                           {.low = 9.0},
                                           {.high = 7.0},
                                           {.slope_per_m = 0.0},
                                           {.slope_per_m = -1400.0},
                                           {.noise = -0.01},
                                           {.noise = nan},
                                           {.bias = nan},
                                           {.fraction = 0.0},
                                           {.fraction = 1.0},
                                           {.fraction = nan},
                                           {.bias_axis = {nan, 0.0, 0.0}},
                                           {.bias_axis = {0.0, 0.0, 1.0}}};
  for (const StiffnessModel& model : bad) EXPECT_THROW(Phantom(tissue, {}, model), InvalidInput);
  EXPECT_THROW(Phantom(tissue, {Disk{.radius_m = -1.0}}, {}), InvalidInput);
}

// Travelling along x, a probe that is 2 mm late feels at (18, 30) what is at (16, 30); along -y
// what is at (18, 32). At rest nothing is late.
TEST(Phantom, AnswersLateAlongTheTravel) {
  const Surface tissue = sheet(0.025, 0.050, 0.001);
  const Phantom late(tissue, {kDisk}, {.lag_m = 0.002});
  const SurfacePoint where = tissue.at_vertex(vertex_at_mm(tissue, 18, 30));
  Random random(1);
  EXPECT_NEAR(late.touch(where, Vec3::UnitX(), random).reading, reading_at_mm(late, tissue, 16, 30),
              1e-9);
  EXPECT_NEAR(late.touch(where, -Vec3::UnitY(), random).reading,
              reading_at_mm(late, tissue, 18, 32), 1e-9);
  EXPECT_EQ(late.touch(where, Vec3::Zero(), random).reading, reading_at_mm(late, tissue, 18, 30));
  EXPECT_EQ(tissue.position(late.touch(where, Vec3::UnitX(), random).where),
            tissue.position(where));
}

}  // namespace
}  // namespace palpation
