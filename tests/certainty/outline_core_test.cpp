// Tumours of two heights: what is felt of one, its prior, and when readings tell of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "certainty/outline_core_start.h"
#include "certainty/outline_lines.h"
#include "certainty/outline_walk.h"
#include "palpation/certainty/outline_posterior.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

constexpr double kMm = 1e-3, kSlope_per_m = 2000.0;

using Share = std::function<double(const Vec2& place)>;

double sigmoid_of(double steps) { return 1.0 / (1.0 + std::exp(-steps)); }

/// Of a disk of 4 mm and a wider one of so much of its contrast that holds it.
Share cored(double beside) {
  return [beside](const Vec2& place) {
    const auto disk = [&](const Vec2& middle, double radius_m) {
      return sigmoid_of(kSlope_per_m * (radius_m - (place - middle).norm()));
    };
    return std::max(disk(kMm * Vec2(19, 20), 4 * kMm), beside * disk(kMm * Vec2(20, 20), 9 * kMm));
  };
}

/// It is highest in its middle, and falls evenly to nothing.
double cone(const Vec2& place) {
  return std::clamp(1.0 - (place - kMm * Vec2(20, 20)).norm() / (12 * kMm), 0.0, 1.0);
}

Surface tissue() {
  Random random(1);
  return Surface(make_plane({.size_m = Vec2(0.04, 0.04), .columns = 81, .rows = 81}, random));
}

Field field_of(const Surface& surface, const Share& share) {
  Field field(surface.vertex_count());
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex)
    field[vertex] = 7.0 + 2.0 * share(surface.chart().uv.row(vertex).transpose());
  return field;
}

/// Felt every so many millimetres with a noise, about the line half way up to the highest.
OutlineStart start_of(const Surface& surface, const Share& share, double noise = 0.1,
                      int step = 2) {
  OutlineStart start;
  Random random(2);
  for (int x = 1; x < 40; x += step) {
    for (int y = 1; y < 40; y += step) {
      start.readings.places.push_back(kMm * Vec2(x, y));
      start.readings.reading.push_back(7.0 + 2.0 * share(kMm * Vec2(x, y)) +
                                       noise * random.normal());
      start.readings.variance.push_back(noise * noise);
    }
  }
  OutlineProfile& median = start.prior.median;
  median.low = 7.0;
  median.high = 9.0;
  median.log_slope = std::log(1200.0);
  median.turns.log_half_width = std::log(0.12);
  start.profile = median;
  const Field depth = field_of(surface, share).array() - 8.0;
  begin_with(outline_from(lines_of(surface, depth), start.readings.places), start);
  return start;
}

ChainStarts starts_of(const Share& share, double noise = 0.1, int step = 2) {
  const Surface surface = tissue();
  return with_core_if_paid(start_of(surface, share, noise, step), surface, field_of(surface, share),
                           3);
}

OutlineCore core_at(const Vec2& middle, double radius_m, double beside) {
  return {.middle = middle, .log_radius = std::log(radius_m), .beside = beside};
}

TEST(OutlineCore, TissueBesideItStandsOutBySoMuchLess) {
  OutlinePrior prior;
  OutlineProfile profile;
  profile.low = 7.0;
  profile.high = 9.0;
  profile.log_slope = std::log(4000.0);
  profile.log_contrast = {0.0};
  profile.core = core_at(kMm * Vec2(3, 2), 4 * kMm, 0.5);
  const ReadingLaw law = law_of(profile, prior);
  const auto deep = [&](double x_mm) {
    return share_by_core(law, kMm * Vec2(x_mm, 2), 20 * kMm, 1.0);
  };
  EXPECT_NEAR(deep(3), 1.0, 1e-6);
  EXPECT_NEAR(deep(7), 0.75, 1e-12);
  EXPECT_NEAR(deep(12), 0.5, 1e-6);
}

// Half a millimetre outside of a boundary that the core reaches beyond, and that ends it.
TEST(OutlineCore, EndsWithTheOutlineWhereItReachesBeyond) {
  OutlinePrior prior;
  OutlineProfile profile;
  profile.high = 1.0;
  profile.log_slope = std::log(1000.0);
  profile.log_contrast = {0.0};
  profile.core = core_at(kMm * Vec2(3, 2), 4 * kMm, 0.5);
  const ReadingLaw law = law_of(profile, prior);
  const double depth_m = -0.5 * kMm, share = share_at(law, depth_m);
  EXPECT_EQ(share_by_core(law, kMm * Vec2(5, 2), depth_m, share), share);
  EXPECT_NEAR(share_by_core(law, kMm * Vec2(8, 2), depth_m, share),
              0.5 * share + 0.5 * share_at(law, -kMm), 1e-12);
  EXPECT_EQ(share_by_core(law, Vec2(1, 1), -1.0, 0.0), 0.0);
}

// What a chain adds up step by step is what a fresh one says of where it has come to.
TEST(OutlineCore, StepsLeaveTheDensityWhatItIs) {
  const Surface surface = tissue();
  OutlineStart start = start_of(surface, cored(0.6));
  start.profile.core = core_at(kMm * Vec2(19, 20), 4 * kMm, 0.6);
  OutlineWalk walk(start.readings, start.prior, start.outline, start.profile, 5);
  walk.settle(20);
  const OutlineChain& chain = walk.chain();
  ASSERT_TRUE(chain.profile().core);
  EXPECT_NE(chain.profile().core->beside, 0.6);
  EXPECT_NE(chain.profile().core->middle, start.profile.core->middle);
  const OutlineChain fresh(start.readings, start.prior, chain.outline(), chain.profile(),
                           chain.cuts(), &chain.residuals());
  EXPECT_NEAR(chain.log_density(), fresh.log_density(), 1e-7);
}

// Readings that tell nothing: its middle is about the tumour's, as far as that is wide, its radius,
// over half of the tumour's, is lognormal, its length exponential, and what lies beside it anything
// from 0.4 to all of its contrast.
TEST(OutlineCore, IsDrawnFromItsPriorWhereReadingsTellNothing) {
  const Surface surface = tissue();
  OutlineStart start = start_of(surface, cored(0.6));
  for (double& variance : start.readings.variance) variance = 1e12;
  start.prior.residuals.noise_log_sd = 0.01;
  const double median_m = 0.5 * start.prior.radius_m;
  start.profile.core = core_at(kMm * Vec2(19, 20), median_m, 0.6);
  OutlineWalk walk(start.readings, start.prior, start.outline, start.profile, 6);
  walk.settle(200);
  constexpr int kDraws = 1200;
  double beside = 0.0, square = 0.0, z_mean = 0.0, z_square = 0.0, length_m = 0.0, off = 0.0;
  for (const OutlineDraw& draw : walk.draws(kDraws, kDraws)) {
    const OutlineCore& core = *draw.profile.core;
    const double z = (core.log_radius - std::log(median_m)) / 0.7;
    beside += core.beside / kDraws;
    square += core.beside * core.beside / kDraws;
    z_mean += z / kDraws;
    z_square += z * z / kDraws;
    length_m += core.half_length_m / kDraws;
    off += (core.middle - start.prior.middle).norm() / start.prior.radius_m / kDraws;
  }
  EXPECT_NEAR(beside, 0.7, 0.02);
  EXPECT_NEAR(std::sqrt(square - beside * beside), 0.6 / std::sqrt(12.0), 0.01);
  EXPECT_NEAR(z_mean, 0.0, 0.15);
  EXPECT_NEAR(std::sqrt(z_square - z_mean * z_mean), 1.0, 0.12);
  EXPECT_NEAR(length_m, median_m, 0.2 * median_m);
  EXPECT_NEAR(off, std::sqrt(0.5 * std::numbers::pi), 0.15);  // Rayleigh's law
}

TEST(OutlineCore, IsFoundWhereReadingsLieOnAPlateauBesideIt) {
  const auto [start, other] = starts_of(cored(0.55)).of;
  ASSERT_TRUE(start.profile.core);
  EXPECT_TRUE(other.profile.core);
  OutlineWalk walk(start.readings, start.prior, start.outline, start.profile, 4);
  walk.settle(300);
  double area_m2 = 0.0, beside = 0.0, square = 0.0;
  for (const OutlineDraw& draw : walk.draws(300, 100)) {
    const double of_draw = draw.profile.core->beside;
    beside += of_draw / 100.0;
    square += of_draw * of_draw / 100.0;
    area_m2 += enclosed_area(draw.outline.place) / 100.0;
  }
  const double sd = std::sqrt(square - beside * beside);
  EXPECT_LT(sd, 0.03);
  EXPECT_NEAR(beside, 0.55, 3.0 * sd);
  EXPECT_NEAR(area_m2, std::numbers::pi * 81e-6, 8e-6);
}

// Two thirds of the contrast beside it and 8 % noise: of the outlines that begin at various heights
// the one whose readings lie on a plateau is nowhere near the likeliest before it has settled.
TEST(OutlineCore, IsNotLostWhereTheRimIsNearlyAsStiff) {
  const auto [plain, cored_start] = starts_of(cored(0.65), 0.16).of;
  ASSERT_TRUE(cored_start.profile.core);
  EXPECT_GT(enclosed_area(cored_start.outline.place), 0.85 * std::numbers::pi * 81e-6);
}

TEST(OutlineCore, IsNotFoundInATumourOfOneHeight) {
  const Share disk = [](const Vec2& place) {
    return sigmoid_of(kSlope_per_m * (9 * kMm - (place - kMm * Vec2(20, 20)).norm()));
  };
  const OutlineDraws drawn = draws_from(starts_of(disk, 0.1, 3), 80, 5);
  const auto cores = std::ranges::count_if(
      drawn.draws, [](const OutlineDraw& draw) { return draw.profile.core.has_value(); });
  EXPECT_LE(cores, 8);
}

/// Within 1.5 mm on one side, and within 10 on the other, where some readings lie between nothing
/// and all: as tissue of a second height would have them.
double gentle_on_a_side(const Vec2& place) {
  const Vec2 off = place - kMm * Vec2(20, 20);
  const double rise_m = 1.5 * kMm + 8.5 * kMm * sigmoid_of(550.0 * off.x());
  return sigmoid_of(2.0 * std::log(9.0) / rise_m * (10 * kMm - off.norm()));
}

TEST(OutlineCore, IsNotSureInATumourThatEndsGentlyOnASide) {
  EXPECT_FALSE(starts_of(gentle_on_a_side, 0.04, 3).of.front().profile.core);
}

/// Its slope is too gentle for a plateau beside the core: a skirt explains it as well.
double gentle(const Vec2& place) {
  const auto disk = [&](double radius_m) {
    return sigmoid_of(700.0 * (radius_m - (place - kMm * Vec2(20, 20)).norm()));
  };
  return std::max(disk(4 * kMm), 0.5 * disk(8 * kMm));
}

// The two end elsewhere, and that fewer numbers do it tells of no tissue.
TEST(OutlineCore, IsOneOfTwoThatEndElsewhereWhereReadingsTellNeither) {
  const auto [plain, cored] = starts_of(gentle, 0.1, 3).of;
  EXPECT_FALSE(plain.profile.core);
  EXPECT_TRUE(cored.profile.core);
}

// A chain that begins with a core in an outline that reaches farther comes to one in the other,
// which no reading tells from none.
TEST(OutlineCore, IsOfOutlinesThatReachFartherAlone) {
  const ChainStarts starts = starts_of(gentle, 0.1, 3);
  ASSERT_GT(starts.least_area_m2, 0.0);
  const OutlineDraws drawn = draws_from(starts, 80, 5);
  ASSERT_EQ(drawn.draws.size(), 80U);
  int cores = 0;
  for (const OutlineDraw& draw : drawn.draws) {
    if (!draw.profile.core) continue;
    ++cores;
    EXPECT_GE(enclosed_area(draw.outline), starts.least_area_m2);
  }
  EXPECT_GT(cores, 0);
  EXPECT_LE(cores, 40);
}

// It has no plateau anywhere: that it has a core is never all that is said.
TEST(OutlineCore, IsNotClaimedOfACone) { EXPECT_FALSE(starts_of(cone).of.front().profile.core); }

// 20 mm2 between the two, where 15 and then 25 are wrong in any case.
TEST(OutlineCore, MattersWhereItMakesMoreOfADifferenceThanTheRestIsUnsure) {
  OutlinePosterior posterior;
  posterior.expected = {.missed_m2 = 10e-6, .extra_m2 = 5e-6};
  DrawnCore& core = posterior.core.emplace();
  core.with_m2 = 80e-6;
  core.without_m2 = 60e-6;
  core.probability = 0.4;
  EXPECT_TRUE(posterior.core_matters());
  posterior.expected.extra_m2 = 15e-6;
  EXPECT_FALSE(posterior.core_matters());
  core.probability = 1.0;
  EXPECT_TRUE(posterior.core_matters());
  posterior.core.reset();
  EXPECT_FALSE(posterior.core_matters());
}

}  // namespace
}  // namespace palpation
