#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "exploration/background_search.h"
#include "palpation/base/random.h"
#include "palpation/exploration/conclusion.h"
#include "palpation/geometry/make_plane.h"
#include "readings/way.h"

namespace palpation {
namespace {

double disk(const Vec3& place) {
  return 2.0 / (1.0 + std::exp(-1200.0 * (0.007 - (place - Vec3(0.018, 0.022, 0.0)).norm())));
}

/// On tissue that slopes.
std::vector<Palpation> palpations_of(const Surface& surface, int count) {
  Random random(5);
  std::vector<Palpation> palpations;
  for (int i = 0; i < count; ++i) {
    const int vertex = random.below(surface.vertex_count());
    const Vec3 place = surface.vertex(vertex);
    palpations.push_back({.where = surface.at_vertex(vertex),
                          .reading = 7.0 + disk(place) + 60.0 * place.x() + 0.1 * random.normal(),
                          .batch = i / 15});
  }
  return palpations;
}

TEST(ConclusionCache, OfWhatWasTriedChangesNothing) {
  Random random(0);
  const Surface surface(make_plane({.size_m = {0.04, 0.05}, .columns = 41, .rows = 51}, random));
  const std::vector<Palpation> palpations = palpations_of(surface, 60);
  const Model model{.level = {.estimate = LevelEstimate::Edge}, .contrast = {.scale = {}}};
  ConclusionCache cache;
  const Conclusion first = conclude(surface, model, palpations, &cache),
                   again = conclude(surface, model, palpations, &cache),
                   alone = conclude(surface, model, palpations);
  ASSERT_TRUE(alone.level);
  ASSERT_FALSE(alone.evidence.taken_back.empty());
  for (const Conclusion* one : {&first, &again}) {
    EXPECT_EQ(one->level->value, alone.level->value);
    EXPECT_EQ(one->edge->depth(), alone.edge->depth());
    EXPECT_EQ(one->evidence.taken_back.front().background.slope_per_m,
              alone.evidence.taken_back.front().background.slope_per_m);
  }
}

TEST(ConclusionCache, RemembersWhatWasTriedOnTheseReadingsAlone) {
  Random random(0);
  const Surface surface(make_plane({.size_m = {0.04, 0.05}, .columns = 41, .rows = 51}, random));
  std::vector<Palpation> palpations = with_travel(surface, palpations_of(surface, 30));
  const Model model{.level = {.estimate = LevelEstimate::Edge}};
  ConclusionCache cache;
  EXPECT_FALSE(cache.tried(surface, model, palpations));
  conclude(surface, model, palpations, &cache);
  EXPECT_TRUE(cache.tried(surface, model, palpations));
  EXPECT_FALSE(cache.tried(surface, {.level = {.fraction = 0.4}}, palpations));
  palpations.back().reading += 0.1;
  EXPECT_FALSE(cache.tried(surface, model, palpations));
  palpations.pop_back();
  EXPECT_FALSE(cache.tried(surface, model, palpations));
}

// The third reading at the end of the sensor's range tells what the first two are.
TEST(ConclusionCache, ForgetsAReadingWhoseBoundOthersTell) {
  Random random(0);
  const Surface surface(make_plane({.size_m = {0.04, 0.05}, .columns = 41, .rows = 51}, random));
  std::vector<Palpation> palpations = palpations_of(surface, 60);
  for (Palpation& one : palpations) one.reading = 7.0 + 0.5 * random.normal();
  for (const int at_end : {3, 20, 40, 50}) palpations[at_end].reading = 9.0;
  const Model model{
      .field = {.kernel = {.length_m = 0.0033, .signal_sd = 1.0}, .noise = {.sd = 0.1}}};
  const auto bound = [](const Conclusion& conclusion) {
    return std::ranges::count(conclusion.belief.palpations(), Bound::AtLeast, &Palpation::bound);
  };
  ConclusionCache cache;
  EXPECT_EQ(bound(conclude(surface, model, std::span(palpations).first(30), &cache)), 0);
  EXPECT_EQ(bound(conclude(surface, model, palpations, &cache)), 4);
  EXPECT_EQ(bound(conclude(surface, model, palpations)), 4);
}

}  // namespace
}  // namespace palpation
