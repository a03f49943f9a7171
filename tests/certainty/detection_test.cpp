#include "certainty/detection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "belief/tissue.h"
#include "palpation/base/error.h"
#include "palpation/base/random.h"

namespace palpation {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// One place in a corner of 25 x 50 mm, without noise: the farthest centre of a disk is the opposite
// corner, 55.9017 mm away.
TEST(DiameterRuledOut, IsTheLargestEmptyDiskWhereReadingsAreExact) {
  const Surface tissue = plane(26, 51);
  const std::vector<Vec3> corner = {Vec3::Zero()};
  EXPECT_NEAR(diameter_ruled_out_m(tissue, corner, {.contrast_to_noise = kInfinite}).value(),
              2.0 * std::hypot(0.025, 0.050), 2e-5);
  const std::vector<Vec3> both = {Vec3::Zero(), Vec3(0.025, 0.050, 0.0)};
  EXPECT_LT(diameter_ruled_out_m(tissue, both, {.contrast_to_noise = kInfinite}).value(), 0.08);
}

TEST(DiameterRuledOut, FallsWithReadingsAndContrast) {
  const Surface tissue = plane(26, 51);
  std::vector<Vec3> places;
  double before = kInfinite;
  for (const double step : {0.006, 0.004, 0.0025}) {
    places.clear();
    for (double x = 0.5 * step; x < 0.025; x += step) {
      for (double y = 0.5 * step; y < 0.050; y += step) places.emplace_back(x, y, 0.0);
    }
    const double faint = diameter_ruled_out_m(tissue, places, {.contrast_to_noise = 4.0}).value();
    const double plain = diameter_ruled_out_m(tissue, places, {.contrast_to_noise = 20.0}).value();
    const double surer =
        diameter_ruled_out_m(tissue, places, {.contrast_to_noise = 4.0, .probability = 0.999})
            .value();
    EXPECT_LT(faint, before);
    EXPECT_LT(plain, faint);
    EXPECT_GT(surer, faint);
    EXPECT_GE(plain, std::sqrt(2.0) * step -
                         1e-3);  // the gap between four readings, but for the mesh's 1 mm
    before = faint;
  }
}

struct Disks {
  Surface tissue = plane(26, 51);
  std::vector<Vec3> places;
  Disks() {
    Random random(4);
    for (int i = 0; i < 80; ++i)
      places.emplace_back(0.025 * random.uniform(), 0.050 * random.uniform(), 0.0);
  }
  /// Readings with noise of one, and a disk of some contrast.
  std::vector<double> felt(Random& random, double contrast, const Vec3& centre,
                           double radius) const {
    std::vector<double> readings;
    for (const Vec3& place : places)
      readings.push_back(random.normal() +
                         contrast / (1.0 + std::exp(-1200.0 * (radius - (place - centre).norm()))));
    return readings;
  }
};

// Noise alone: among 100 draws at most one may stand out that far (1 in 300 is what the choice
// among all disks makes of it).
TEST(GreatestExcess, SeldomStandsOutOfNoise) {
  const Disks disks;
  Random random(7);
  int alarms = 0;
  for (int draw = 0; draw < 100; ++draw)
    alarms += greatest_excess(disks.tissue, disks.places,
                              disks.felt(random, 0.0, Vec3::Zero(), 0.001)) > kNeededToFind;
  EXPECT_LE(alarms, 1);
}

TEST(GreatestExcess, DoesNotDependOnUnitOrZero) {
  const Disks disks;
  Random random(8);
  std::vector<double> readings = disks.felt(random, 4.0, Vec3(0.012, 0.02, 0.0), 0.006);
  const double excess = greatest_excess(disks.tissue, disks.places, readings);
  EXPECT_GT(excess, kNeededToFind);
  for (double& reading : readings) reading = 7.0 + 0.01 * reading;
  EXPECT_NEAR(greatest_excess(disks.tissue, disks.places, readings), excess, 1e-9);
  EXPECT_EQ(greatest_excess(disks.tissue, disks.places, std::vector<double>(80, 7.0)), 0.0);
  EXPECT_EQ(greatest_excess(disks.tissue, {}, {}), 0.0);
}

// The claim itself: disks of exactly the diameter that is ruled out, at random places, are missed
// in no more than 5 % of 100 draws, and two standard errors of 2.2 % besides.
TEST(DiameterRuledOut, IsFoundByTheRuleThatIsInForce) {
  const Disks disks;
  for (const double contrast : {4.0, 10.0}) {
    const double radius =
        0.5 *
        diameter_ruled_out_m(disks.tissue, disks.places, {.contrast_to_noise = contrast}).value();
    Random random(9);
    int found = 0;
    const int draws = 100;
    for (int draw = 0; draw < draws; ++draw) {
      const Vec3 centre = disks.tissue.vertex(random.below(disks.tissue.vertex_count()));
      found += greatest_excess(disks.tissue, disks.places,
                               disks.felt(random, contrast, centre, radius)) > kNeededToFind;
    }
    EXPECT_GE(found, draws * (0.95 - 0.044));
  }
}

// Disks of exactly that diameter at random places: their matched filter, noise drawn, must exceed
// what is needed in 95 % of 2,000 draws, less three standard errors of 0.5 %.
TEST(DiameterRuledOut, IsMissedNoMoreOftenThanItSays) {
  const Surface tissue = plane(26, 51);
  Random random(4);
  std::vector<Vec3> places;
  for (int i = 0; i < 80; ++i)
    places.emplace_back(0.025 * random.uniform(), 0.050 * random.uniform(), 0.0);
  for (const double contrast : {4.0, 8.0, 20.0}) {
    const double radius =
        0.5 * diameter_ruled_out_m(tissue, places, {.contrast_to_noise = contrast}).value();
    int found = 0;
    const int draws = 2000;
    for (int draw = 0; draw < draws; ++draw) {
      const Vec3 centre = tissue.vertex(random.below(tissue.vertex_count()));
      double signal = 0.0, squares = 0.0;
      for (const Vec3& place : places) {
        const double rise = 1.0 / (1.0 + std::exp(-1200.0 * (radius - (place - centre).norm())));
        signal += rise * (contrast * rise + random.normal());
        squares += rise * rise;
      }
      found += signal / std::sqrt(squares) > kNeededToFind;
    }
    EXPECT_GE(found, draws * (0.95 - 0.015));
  }
}

TEST(DiameterRuledOut, IsNothingWithoutReadings) {
  const Surface tissue = plane(5, 5);
  EXPECT_FALSE(diameter_ruled_out_m(tissue, {}, {.contrast_to_noise = kInfinite}).has_value());
  const std::vector<Vec3> one = {Vec3::Zero()};
  EXPECT_FALSE(diameter_ruled_out_m(tissue, one, {.contrast_to_noise = 4.0}).has_value())
      << "one reading cannot tell";
  EXPECT_THROW(diameter_ruled_out_m(tissue, one, {.contrast_to_noise = 0.0}), InvalidInput);
  EXPECT_THROW(diameter_ruled_out_m(tissue, one, {.slope_per_m = kInfinite}), InvalidInput);
  EXPECT_THROW(diameter_ruled_out_m(tissue, one, {.probability = 1.0}), InvalidInput);
}

}  // namespace
}  // namespace palpation
