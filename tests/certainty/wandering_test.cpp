// Places that wander: told from places that are known, and drawn with the outlines.
#include "certainty/wandering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace palpation {
namespace {

constexpr double kMm = 1e-3, kRadius_m = 6 * kMm, kNoise = 0.06;  // of a contrast of 2
constexpr int kCount = 280;

/// Where tissue lies when a reading is made.
using Way = std::function<Vec2(int number)>;

Vec2 at_rest(int) { return Vec2::Zero(); }
Vec2 breathing(int number) {
  return 2 * kMm * std::sin(2.0 * std::numbers::pi * number / 40.0) * Vec2(0.8, 0.6);
}
Way each_elsewhere(std::uint64_t seed) {
  return [seed](int number) {
    Random random(seed + static_cast<std::uint64_t>(number));
    return Vec2(1.2 * kMm * Vec2(random.normal(), random.normal()));
  };
}

/// Of a disk that is felt at random places of 24 by 24 mm about it.
OutlineStart start_of(const Way& way, std::uint64_t seed, int count = kCount,
                      double noise = kNoise) {
  OutlineStart start;
  Random random(seed);
  OutlineReadings& readings = start.readings;
  for (int i = 0; i < count; ++i) {
    const Vec2 place = 24 * kMm * Vec2(random.uniform() - 0.5, random.uniform() - 0.5);
    const double depth_m = kRadius_m - (place - way(i)).norm();
    readings.places.push_back(place);
    readings.reading.push_back(7.0 + 2.0 / (1.0 + std::exp(-1400.0 * depth_m)) +
                               noise * random.normal());
    readings.variance.push_back(noise * noise);
    readings.made.push_back({{.number = static_cast<std::size_t>(i)}});
  }
  std::vector<Vec2> circle;
  for (int i = 0; i < 38; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 38.0;
    circle.push_back(kRadius_m * Vec2(std::cos(angle), std::sin(angle)));
  }
  OutlineNodes outline;
  outline.add(circle, 0);
  start.profile = {.low = 7.0,
                   .high = 9.0,
                   .log_slope = std::log(1200.0),
                   .turns = {.log_half_width = std::log(0.12)},
                   .log_spacing = {},
                   .log_contrast = {}};
  start.prior.median = start.profile;
  start.prior.plateaus = {.low_sd = 0.5, .high_sd = 0.5};
  start.prior.residuals.wild_density = 1.0 / 3.0;
  begin_with(outline, start);
  return start;
}

OutlineStart wandering(OutlineStart start) {
  let_wander(ways_of(start.readings.made), start);
  return start;
}

std::vector<OutlineDraw> draws_of(const OutlineStart& start, std::uint64_t seed) {
  OutlineWalk walk(start.readings, start.prior, start.outline, start.profile, seed);
  walk.settle(400);
  return walk.draws(400, 100);
}

TEST(Wandering, IsNotFoundWhereTissueRests) {
  for (const std::uint64_t seed : {1, 2})
    EXPECT_FALSE(do_places_wander(wandering(start_of(at_rest, seed)), seed)) << seed;
}

// Beforehand places may wander by millimetres; few or noisy readings leave that as it is.
TEST(Wandering, IsNotFoundWhereReadingsTellNothingOfIt) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    EXPECT_FALSE(do_places_wander(wandering(start_of(at_rest, seed, 15, 0.4)), seed)) << seed;
    EXPECT_FALSE(do_places_wander(wandering(start_of(at_rest, seed, 40, 1e6)), seed)) << seed;
  }
}

// A place that was touched four times is known twice as well, as far as each touch errs for itself.
TEST(Wandering, MeansOfSeveralReadingsWanderLess) {
  OutlineStart start = start_of(at_rest, 6, 30);
  start.readings.made[0] = {{.number = 0}, {.number = 30}, {.number = 31}, {.number = 32}};
  start = wandering(std::move(start));
  EXPECT_EQ(start.readings.ways.own[0], 0.5);
  EXPECT_EQ(start.readings.ways.own[1], 1.0);
  EXPECT_LT(start.readings.ways.lasting.row(0).squaredNorm(), 0.6);
  EXPECT_GT(start.readings.ways.lasting.row(1).squaredNorm(), 0.9);
}

TEST(Wandering, IsFoundWhereTissueBreathes) {
  for (const std::uint64_t seed : {1, 2})
    EXPECT_TRUE(do_places_wander(wandering(start_of(breathing, seed)), seed)) << seed;
}

TEST(Wandering, IsFoundWhereEachPlaceIsOff) {
  for (const std::uint64_t seed : {1, 2})
    EXPECT_TRUE(do_places_wander(wandering(start_of(each_elsewhere(100 * seed), seed)), seed))
        << seed;
}

// Ways are known up to one that all have, which is the outline's own place.
TEST(Wandering, DrawsTheWaysThatTissueWent) {
  const OutlineStart start = wandering(start_of(breathing, 3));
  const std::vector<OutlineDraw> draws = draws_of(start, 3);
  const WanderingPlaces found = wandering_by(draws, start.readings);
  EXPECT_TRUE(found.is_sure());
  EXPECT_GT(found.lasting.mean, 0.5);
  const double rms_m = 2 * kMm / std::numbers::sqrt2;
  EXPECT_LT(found.way_m.least, rms_m);
  EXPECT_GT(found.way_m.most, rms_m);
  Eigen::MatrixX2d mean = Eigen::MatrixX2d::Zero(kCount, 2), truth(kCount, 2);
  for (const OutlineDraw& draw : draws) {
    for (int i = 0; i < kCount; ++i)
      mean.row(i) += 0.01 * way_of(draw.profile.wandering, start.readings, i).transpose();
  }
  // Tissue that went there is felt as if the probe went back.
  for (int i = 0; i < kCount; ++i) truth.row(i) = -breathing(i).transpose();
  mean.rowwise() -= mean.colwise().mean();
  truth.rowwise() -= truth.colwise().mean();
  EXPECT_GT(mean.cwiseProduct(truth).sum() / (mean.norm() * truth.norm()), 0.8);
  EXPECT_LT((mean - truth).norm(), 0.6 * truth.norm());
}

TEST(Wandering, TellsWaysThatLastFromThoseOfEach) {
  const OutlineStart start = wandering(start_of(each_elsewhere(500), 5));
  const WanderingPlaces found = wandering_by(draws_of(start, 5), start.readings);
  EXPECT_TRUE(found.is_sure());
  EXPECT_LT(found.lasting.mean, 0.5);
}

TEST(Wandering, IsLessThanMattersWhereTissueRests) {
  const OutlineStart start = wandering(start_of(at_rest, 4));
  const WanderingPlaces found = wandering_by(draws_of(start, 4), start.readings);
  EXPECT_LT(found.way_m.mean, 0.3 * kMm);
  EXPECT_FALSE(found.is_sure());
}

}  // namespace
}  // namespace palpation
