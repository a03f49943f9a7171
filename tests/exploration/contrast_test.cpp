// What counts as a tumour's contrast: differences of readings or of their logarithms, how small one
// may be, and how large a tumour of it may go undetected.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "belief/tissue.h"
#include "exploration/search_goal.h"
#include "palpation/base/error.h"
#include "palpation/exploration/exploration.h"
#include "palpation/world/phantom.h"

namespace palpation {
namespace {

const Vec3 kStrong(0.0125, 0.034, 0.0), kWeak(0.0125, 0.014, 0.0);

/// A grid of readings every 2 mm, of which `reading` makes what is felt.
template <typename Reading>
std::vector<Palpation> felt_everywhere(const Surface& tissue, const Phantom& phantom,
                                       const Reading& reading) {
  Random random(5);
  std::vector<Palpation> readings;
  for (double x = 0.0015; x < 0.025; x += 0.002) {
    for (double y = 0.001; y < 0.050; y += 0.002) {
      Palpation one =
          phantom.touch(tissue.at_vertex(tissue.nearest_vertex(Vec3(x, y, 0.0))), random);
      one.reading = reading(one.reading);
      readings.push_back(one);
    }
  }
  return readings;
}

Phantom one_disk(const Surface& tissue) {
  return Phantom(tissue, {Disk{kStrong, 0.006}}, {.low = 0.0, .high = 1.0, .noise = 0.05});
}

Phantom two_disks(const Surface& tissue, double contrast = 0.62) {
  PhantomDesign design{.model = {.noise = 0.03}};
  design.lumps.resize(2);
  design.lumps[0].outline = Disk{kStrong, 0.006};
  design.lumps[1].outline = Disk{kWeak, 0.005};
  design.lumps[1].contrast = contrast;
  return Phantom(tissue, design);
}

double same(double reading) { return reading; }

// Ten times the readings are the logarithms and a constant: the same boundary, and ten times the
// level. 1e-6 mm and 1e-9: what learning stops at.
TEST(Transform, OfLogarithmsDoesNotDependOnTheUnit) {
  const Surface tissue = plane(51, 101);
  const Phantom phantom = one_disk(tissue);
  const auto concluded = [&](double unit) {
    return conclude(tissue, {.contrast = {.scale = ReadingScale::Log}},
                    felt_everywhere(tissue, phantom, [&](double felt) {
                      return unit * 0.2 * std::exp(2.0 * felt);
                    }));
  };
  const Conclusion one = concluded(1.0), ten = concluded(10.0);
  ASSERT_TRUE(one.contour && ten.contour);
  EXPECT_LT((one.contour->field - ten.contour->field).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_NEAR(level_in_readings(ten)->value / level_in_readings(one)->value, 10.0, 1e-3);
  EXPECT_NEAR(*level_in_readings(ten)->stddev / *level_in_readings(one)->stddev, 10.0, 1e-2);
}

// Half way between ln .2 and ln 1.5 is .2 e = .54, where the raw readings' middle is .84.
TEST(Transform, PutsTheLevelHalfWayBetweenTheLogarithms) {
  const Surface tissue = plane(51, 101);
  const Conclusion conclusion = conclude(tissue, {.contrast = {.scale = ReadingScale::Log}},
                                         felt_everywhere(tissue, one_disk(tissue), [](double felt) {
                                           return 0.2 * std::exp(2.0 * felt);
                                         }));
  const Level level = *level_in_readings(conclusion);
  EXPECT_NEAR(level.value, 0.2 * std::exp(1.0), 4.0 * *level.stddev);
  EXPECT_LT(*level.stddev, 0.05);
  for (std::size_t i = 0; i < conclusion.palpations.size(); ++i)
    EXPECT_GT(conclusion.palpations[i].reading, 0.1) << "as it was made, not its logarithm";
}

// Noise that is alike on both plateaus is so on one scale alone.
TEST(Transform, IsToldByTheReadings) {
  const Surface tissue = plane(51, 101);
  const auto scale_of = [&](const std::function<double(double)>& change) {
    return conclude(tissue, {.contrast = {.scale = {}}},
                    felt_everywhere(tissue, one_disk(tissue), change))
        .scale();
  };
  EXPECT_EQ(scale_of([](double felt) { return 0.2 * std::exp(2.0 * felt); }), ReadingScale::Log);
  EXPECT_EQ(scale_of([](double felt) { return 0.2 + 2.0 * felt; }), ReadingScale::Raw);
  EXPECT_EQ(scale_of([](double felt) { return std::exp(2.0 * felt) - 1.2; }), ReadingScale::Raw)
      << "not positive";
}

// At the end outlines tell, whose profile may be bent: an edge alone is a sigmoid, which even noise
// of a hundredth on readings that are thrice as high looks like on logarithms.
TEST(Transform, IsToldByOutlinesAtTheEnd) {
  const Surface tissue = plane(51, 101);
  const Phantom sharp(tissue, {Disk{kStrong, 0.006}}, {.low = 0.0, .high = 1.0, .noise = 0.01});
  const auto concluded = [&](const std::function<double(double)>& change) {
    const std::vector<Palpation> all = felt_everywhere(tissue, sharp, change);
    std::vector<Palpation> every_third;
    for (std::size_t i = 0; i < all.size(); i += 3) every_third.push_back(all[i]);
    return conclude(tissue, {}, every_third, nullptr, 3);
  };
  const Conclusion even = concluded([](double felt) { return 0.2 + 0.4 * felt; });
  EXPECT_EQ(even.scale(), ReadingScale::Raw);
  EXPECT_FALSE(even.evidence.area_by_logarithms_m2);
  const Conclusion in_proportion =
      concluded([](double felt) { return 0.2 * std::exp(2.0 * felt); });
  ASSERT_TRUE(in_proportion.evidence.area_by_logarithms_m2);
  EXPECT_NEAR(*in_proportion.evidence.area_by_logarithms_m2 * 1e6, 113.1, 4.0);
  EXPECT_EQ(in_proportion.scale(), ReadingScale::Raw) << "what is not told moves nothing";
}

TEST(Transform, IsNoneWhereAValueIsInTheReadingsUnit) {
  const Surface tissue = plane(51, 101);
  const std::vector<Palpation> skewed = felt_everywhere(
      tissue, one_disk(tissue), [](double felt) { return 0.2 * std::exp(2.0 * felt); });
  EXPECT_EQ(conclude(tissue, {}, skewed).scale(), ReadingScale::Log);
  EXPECT_EQ(conclude(tissue, {.contrast = {.least = 0.1}}, skewed).scale(), ReadingScale::Raw);
  Model noise_given;
  noise_given.field.noise.sd = 0.05;
  EXPECT_EQ(conclude(tissue, noise_given, skewed).scale(), ReadingScale::Raw);
}

// As a real phantom of two nodules reads, five to fifteen times as much as what lies beside them
// and one place in one of them twice that: by readings as they are nothing else stands out.
TEST(Transform, LetsNoHighReadingHideNodules) {
  const Surface tissue = plane(51, 101);
  PhantomDesign design{.model = {.low = 0.0, .high = 1.0, .noise = 0.05}};
  design.lumps.resize(2);
  design.lumps[0].outline = Disk{kStrong, 0.005};
  design.lumps[1].outline = Disk{kWeak, 0.005};
  design.lumps[1].contrast = 0.6;
  std::vector<Palpation> readings = felt_everywhere(
      tissue, Phantom(tissue, design), [](double felt) { return 0.17 * std::exp(2.3 * felt); });
  std::ranges::max_element(readings, {}, &Palpation::reading)->reading = 4.66;
  const Conclusion conclusion = conclude(tissue, {}, readings);
  ASSERT_TRUE(conclusion.contour);
  for (const Vec3& nodule : {kStrong, kWeak})
    EXPECT_GE(conclusion.contour->field[tissue.nearest_vertex(nodule)], conclusion.contour->level);
}

TEST(Transform, TakesNoLevelThatHasNoLogarithm) {
  const Surface tissue = plane(26, 51);
  EXPECT_THROW(
      conclude(tissue, {.level = {.known = -1.0}, .contrast = {.scale = ReadingScale::Log}}, {}),
      InvalidInput);
}

// Of 62 and 100 % of a contrast of two, 1.24 and 2: 1.6 lies between. Level 8 cuts both.
TEST(LeastContrast, TakesOutWhatSurelyStandsOutByLess) {
  const Surface tissue = plane(51, 101);
  const std::vector<Palpation> readings = felt_everywhere(tissue, two_disks(tissue), same);
  const Conclusion all = conclude(tissue, {}, readings);
  const Conclusion strong = conclude(tissue, {.contrast = {.least = 1.6}}, readings);
  const int weak = tissue.nearest_vertex(kWeak), stiff = tissue.nearest_vertex(kStrong);
  ASSERT_TRUE(all.contour && strong.contour);
  EXPECT_GE(all.contour->field[weak], all.contour->level);
  EXPECT_LT(strong.contour->field[weak], strong.contour->level);
  EXPECT_GE(strong.contour->field[stiff], strong.contour->level);
  EXPECT_LT(strong.certainty->score[weak], 0.0);
  EXPECT_LT(strong.certainty->expected.extra_m2, all.certainty->expected.extra_m2);
  ASSERT_EQ(strong.evidence.weaker.size(), 1u);
  EXPECT_LT((tissue.position(strong.evidence.weaker[0].where) - kWeak).norm(), 0.005);
  EXPECT_NEAR(strong.evidence.weaker[0].contrast, 1.24, 0.15);
  EXPECT_TRUE(all.evidence.weaker.empty());
}

TEST(LeastContrast, LeavesNothingWhereAllIsWeak) {
  const Surface tissue = plane(51, 101);
  const Conclusion none = conclude(tissue, {.contrast = {.least = 3.0}},
                                   felt_everywhere(tissue, two_disks(tissue), same));
  EXPECT_FALSE(none.level || none.contour || none.certainty || none.evidence.contrast_seen);
  EXPECT_EQ(none.evidence.weaker.size(), 2u);
}

// Nothing tells a weak tumour from a vessel: the outline does not hold it, and the band does.
TEST(DoubtfulPart, OfAThirdOfTheContrastIsAsLikelyTumourAsNot) {
  const Surface tissue = plane(51, 101);
  const Conclusion conclusion =
      conclude(tissue, {}, felt_everywhere(tissue, two_disks(tissue, 0.33), same));
  const int weak = tissue.nearest_vertex(kWeak);
  ASSERT_TRUE(conclusion.contour && conclusion.certainty);
  EXPECT_LT(conclusion.contour->field[weak], conclusion.contour->level);
  const Certainty& certainty = *conclusion.certainty;
  EXPECT_NEAR(certainty.probability_inside()[weak], 0.5, 1e-6);
  EXPECT_LT(certainty.score[weak], 0.0);
  ASSERT_EQ(conclusion.evidence.doubtful.size(), 1u);
  const DoubtfulPart& part = conclusion.evidence.doubtful.front();
  EXPECT_LT((tissue.position(part.where) - kWeak).norm(), 0.005);
  const double truth_m2 = 25e-6 * 3.14159265358979;
  EXPECT_NEAR(part.area_m2, truth_m2, 0.25 * truth_m2);
  EXPECT_GT(certainty.expected.missed_m2, 0.5 * part.area_m2);
  for (int degrees = 0; degrees < 360; degrees += 10) {
    const double angle = degrees * 3.14159265358979 / 180.0;
    const Vec3 rim = kWeak + 0.005 * Vec3(std::cos(angle), std::sin(angle), 0.0);
    EXPECT_LT(std::abs(certainty.score[tissue.nearest_vertex(rim)]), certainty.band_score);
  }
}

TEST(DoubtfulPart, IsNoneThatIsSurelyATumourOrStandsOutByTooLittle) {
  const Surface tissue = plane(51, 101);
  const auto doubtful_of = [&](double contrast, const Model& model) {
    return conclude(tissue, model, felt_everywhere(tissue, two_disks(tissue, contrast), same))
        .evidence.doubtful.size();
  };
  EXPECT_EQ(doubtful_of(0.62, {}), 0u);
  EXPECT_EQ(doubtful_of(0.1, {}), 0u);
  EXPECT_EQ(doubtful_of(0.33, {.contrast = {.least = 1.0}}), 0u) << "of a contrast of two";
}

// 16 + 80 touches of 25 x 50 mm.
TEST(SearchGoal, IsReachedWhereTheBudgetAllows) {
  const Surface tissue = plane(26, 51);
  const Phantom healthy(tissue, std::vector<Tumour>{}, {.noise = 0.05});
  Random random(2);
  Exploration exploration(tissue, {}, {.batches = 8, .aim = {.undetected_diameter_m = 0.016}});
  run(exploration, [&](const SurfacePoint& where, const Vec3&) {
    return std::optional(healthy.touch(where, random));
  });
  EXPECT_LE(diameter_ruled_out_m(exploration.conclusion(), 0.95).value(),
            0.01602);  // as near as a diameter is found
}

TEST(SearchGoal, TellsBeforehandHowManyTouchesItTakes) {
  const Surface tissue = plane(26, 51);
  const Conclusion nothing = conclude(tissue, {}, {});
  std::vector<int> all(static_cast<std::size_t>(tissue.vertex_count()));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  const auto needed = [&](double goal_m) {
    return stops_to_goal(nothing, {.undetected_diameter_m = goal_m}, all, 1000).size();
  };
  EXPECT_GT(needed(0.008), needed(0.012));
  EXPECT_GT(needed(0.012), 10u);
  EXPECT_TRUE(stops_to_goal(nothing, {}, all, 1000).empty());
}

TEST(SearchGoal, RefusesWhatIsNone) {
  const Surface tissue = plane(6, 11);
  EXPECT_THROW(Exploration(tissue, {}, {.aim = {.undetected_diameter_m = -1.0}}), InvalidInput);
  EXPECT_THROW(Exploration(tissue, {}, {.aim = {.probability = 1.0}}), InvalidInput);
}

}  // namespace
}  // namespace palpation
