#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <set>
#include <vector>

#include "belief/tissue.h"
#include "certainty/detection.h"
#include "certainty/detection_power.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

std::vector<int> all_of(const Surface& tissue) {
  std::vector<int> all(static_cast<std::size_t>(tissue.vertex_count()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<Vec3> places_of(const Surface& tissue, const std::vector<int>& vertices) {
  std::vector<Vec3> places;
  for (const int vertex : vertices) places.push_back(tissue.vertex(vertex));
  return places;
}

/// The same from its definition: looks at every candidate anew for every touch.
std::vector<int> by_definition(const Surface& tissue, std::size_t readings, const Sought& sought,
                               double diameter_m) {
  std::vector<double> lack(static_cast<std::size_t>(tissue.vertex_count()),
                           needed_rises(readings, sought));
  const auto taken = [&](int touch, int centre) {
    const double depth = 0.5 * diameter_m - (tissue.vertex(touch) - tissue.vertex(centre)).norm();
    const double rise = rise_in_disk(depth, sought.slope_per_m);
    return std::min(rise * rise, lack[static_cast<std::size_t>(centre)]);
  };
  std::vector<int> touches;
  while (touches.size() < 200) {
    int best = -1;
    double most = 1e-12;
    for (int touch = 0; touch < tissue.vertex_count(); ++touch) {
      double sum = 0.0;
      for (int centre = 0; centre < tissue.vertex_count(); ++centre) {
        const double lacking = lack[static_cast<std::size_t>(centre)], less = taken(touch, centre);
        sum += less * (2.0 * lacking - less);  // lacking^2 - (lacking - less)^2
      }
      if (sum > most) {
        most = sum;
        best = touch;
      }
    }
    if (best < 0) return touches;
    touches.push_back(best);
    for (int centre = 0; centre < tissue.vertex_count(); ++centre)
      lack[static_cast<std::size_t>(centre)] -= taken(best, centre);
  }
  return touches;
}

// Thirty readings to come, whose scatter is known as that of thirty.
TEST(TouchesToRuleOut, AreThoseOfTheDefinition) {
  const Surface tissue = plane(13, 26);
  const Sought sought{.contrast_to_noise = 8.0};
  const std::vector<int> all = all_of(tissue);
  EXPECT_EQ(touches_to_rule_out(tissue, {}, sought, 0.012, all, {.candidates = all, .most = 200}),
            by_definition(tissue, 30, sought, 0.012));
}

// As many touches as the fifth part of what is needed, no two in one place: else all that was not
// come to could hide anything.
TEST(TouchesToRuleOut, SpreadBeforeTheyComeAgain) {
  const Surface tissue = plane(26, 51);
  const Sought sought;
  const std::vector<int> all = all_of(tissue);
  const auto most = [&](std::size_t touches) {
    return touches_to_rule_out(tissue, {}, sought, 0.009, all,
                               {.candidates = all, .most = touches});
  };
  const std::size_t needed = most(1000).size();
  const std::vector<int> first = most(needed / 5);
  EXPECT_EQ(std::set<int>(first.begin(), first.end()).size(), first.size());
  const std::vector<Vec3> places = places_of(tissue, most(needed / 2));
  EXPECT_LT(diameter_ruled_out_m(tissue, places, sought).value_or(1.0), 0.020);
}

// What is needed depends a little on how many readings there are, so once more after those.
TEST(TouchesToRuleOut, RuleOutWhatTheyAreFor) {
  const Surface tissue = plane(26, 51);
  const std::vector<int> all = all_of(tissue);
  for (const double contrast : {4.0, 20.0, std::numeric_limits<double>::infinity()}) {
    SCOPED_TRACE(contrast);
    const Sought sought{.contrast_to_noise = contrast};
    std::vector<int> touched;
    for (int round = 0; round < 3; ++round) {
      const std::vector<int> more = touches_to_rule_out(
          tissue, places_of(tissue, touched), sought, 0.010, all, {.candidates = all, .most = 500});
      touched.insert(touched.end(), more.begin(), more.end());
    }
    EXPECT_LE(diameter_ruled_out_m(tissue, places_of(tissue, touched), sought).value(),
              0.010 + 2e-5);
    EXPECT_TRUE(touches_to_rule_out(tissue, places_of(tissue, touched), sought, 0.010, all,
                                    {.candidates = all, .most = 500})
                    .empty());
  }
}

// Every fifth vertex is looked at, until so little is lacking that every vertex is.
TEST(TouchesToRuleOut, LeaveNothingBetweenThoseThatAreLookedAt) {
  const Surface tissue = plane(81, 101);
  const std::vector<int> all = all_of(tissue);
  const Sought sought{.contrast_to_noise = 8.0};
  std::vector<int> touched;
  for (int round = 0; round < 6; ++round) {
    const std::vector<int> more = touches_to_rule_out(tissue, places_of(tissue, touched), sought,
                                                      0.008, all, {.candidates = all, .most = 500});
    touched.insert(touched.end(), more.begin(), more.end());
  }
  EXPECT_LE(diameter_ruled_out_m(tissue, places_of(tissue, touched), sought).value(), 0.008 + 2e-5);
}

// Eight millimetres from every side the tissue is 25 x 50 mm: the first touch does the most where
// no border cuts its disk, and one at a rim half of that.
TEST(TouchesToRuleOut, DoNotBeginAtTheRim) {
  const Surface tissue = plane(26, 51);
  const std::vector<int> all = all_of(tissue);
  const std::vector<int> touches = touches_to_rule_out(tissue, {}, {.contrast_to_noise = 20.0},
                                                       0.008, all, {.candidates = all, .most = 5});
  ASSERT_EQ(touches.size(), 5u);
  for (const int touch : touches) {
    EXPECT_GE(tissue.vertex(touch).x(), 0.0035);
    EXPECT_LE(tissue.vertex(touch).x(), 0.0215);
  }
}

TEST(TouchesToRuleOut, KeepToTheCandidatesAndTheirNumber) {
  const Surface tissue = plane(26, 51);
  const std::vector<int> all = all_of(tissue), some = {3, 300, 700};
  const Sought sought{.contrast_to_noise = 4.0};
  const auto touches = [&](std::span<const int> candidates, std::size_t most) {
    return touches_to_rule_out(tissue, {}, sought, 0.010, all,
                               {.candidates = candidates, .most = most});
  };
  EXPECT_EQ(touches(all, 7).size(), 7u);
  for (const int touch : touches(some, 7))
    EXPECT_TRUE(std::find(some.begin(), some.end(), touch) != some.end());
  EXPECT_TRUE(touches({}, 7).empty());
  EXPECT_THROW(touches_to_rule_out(tissue, {}, sought, 0.0, all, {.candidates = all, .most = 7}),
               InvalidInput);
}

// Vertex by vertex the greatest is the one for all.
TEST(DiametersRuledOut, AreOfEveryCentreWhatOneIsOfAll) {
  const Surface tissue = plane(26, 51);
  const std::vector<int> all = all_of(tissue);
  const std::vector<int> touched = {40, 333, 500, 720, 901, 1100};
  const Sought sought{.contrast_to_noise = std::numeric_limits<double>::infinity()};
  const Field each = diameters_ruled_out_m(tissue, places_of(tissue, touched), sought, all);
  EXPECT_NEAR(each.maxCoeff(),
              diameter_ruled_out_m(tissue, places_of(tissue, touched), sought).value(), 4e-5);
  for (const int vertex : touched) EXPECT_LE(each[vertex], 2e-5);
}

}  // namespace
}  // namespace palpation
