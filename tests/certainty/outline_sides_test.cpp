// Outlines of sides and corners: what readings along straight sides say of a corner that nobody
// touched, and of what curves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "certainty/outline_walk.h"
#include "regular_polygon.h"

namespace palpation {
namespace {

constexpr double kMm = 1e-3, kHalf = 7 * kMm, kNoise = 0.01;
const Vec2 kCorner(kHalf, kHalf);

double depth_in_square(const Vec2& place) {
  const Vec2 beyond = place.cwiseAbs() - Vec2(kHalf, kHalf);
  const double most = beyond.maxCoeff();
  return most < 0.0 ? -most : -beyond.cwiseMax(0.0).norm();
}

/// On 24 by 24 mm, but for 3 mm around a corner: 0 beside it and 1 on it, with a rim of 2 mm.
OutlineReadings felt(const std::function<double(const Vec2& place)>& depth_at) {
  Random random(61);
  OutlineReadings readings;
  while (readings.places.size() < 160) {
    const Vec2 place = 24 * kMm * Vec2(random.uniform() - 0.5, random.uniform() - 0.5);
    if ((place - kCorner).norm() < 3 * kMm) continue;
    readings.places.push_back(place);
    readings.reading.push_back(1.0 / (1.0 + std::exp(-2000.0 * depth_at(place))) +
                               kNoise * random.normal());
    readings.variance.push_back(kNoise * kNoise);
  }
  return readings;
}

/// Of walks from a circle as large, of which one in eight keeps a corner of the square cut off.
std::vector<OutlineDraw> drawn(const OutlineReadings& readings) {
  const OutlineNodes start = regular_polygon(52, 2.0 * kHalf / std::sqrt(std::numbers::pi));
  OutlinePrior prior;
  prior.median = {.low = 0.0,
                  .high = 1.0,
                  .log_slope = std::log(2000.0),
                  .turns = {.log_half_width = std::log(0.12)},
                  .log_spacing = {std::log(kMm)},
                  .log_contrast = {0.0}};
  std::vector<OutlineDraw> all;
  for (const std::uint64_t seed : {1, 2, 3}) {
    OutlineWalk walk(readings, prior, start, prior.median, seed);
    walk.settle(400, 200);
    for (OutlineDraw& draw : walk.draws(400, 100)) all.push_back(std::move(draw));
  }
  return all;
}

double share_of_polygons(const std::vector<OutlineDraw>& draws) {
  const auto is_polygon = [](const OutlineDraw& draw) {
    return draw.profile.turns.kind == LineKind::Polygonal;
  };
  return static_cast<double>(std::ranges::count_if(draws, is_polygon)) /
         static_cast<double>(draws.size());
}

// An arc there would lie 1.5 mm and more within.
TEST(OutlineSides, ACornerThatNobodyTouchedIsAmongTheDraws) {
  const std::vector<OutlineDraw> draws = drawn(felt(depth_in_square));
  EXPECT_GT(share_of_polygons(draws), 0.9);
  std::vector<double> depths;
  for (const OutlineDraw& draw : draws) depths.push_back(depth_in(draw.outline, kCorner));
  std::ranges::sort(depths);
  EXPECT_GT(depths[depths.size() / 2], -0.7 * kMm);
  EXPECT_GT(depths[depths.size() * 9 / 10], -0.1 * kMm);
}

TEST(OutlineSides, WhatCurvesIsNoPolygon) {
  const auto depth_in_disk = [](const Vec2& place) { return 8 * kMm - place.norm(); };
  EXPECT_LT(share_of_polygons(drawn(felt(depth_in_disk))), 0.1);
}

}  // namespace
}  // namespace palpation
