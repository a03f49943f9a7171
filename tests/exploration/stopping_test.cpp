#include "palpation/exploration/stopping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/normal.h"
#include "exploration/search_goal.h"
#include "palpation/base/error.h"
#include "palpation/exploration/exploration.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/world/phantom.h"

namespace palpation {
namespace {

Surface sheet(int columns, int rows) {
  Random random(0);
  return Surface(make_plane({.size_m = {0.025, 0.050}, .columns = columns, .rows = rows}, random));
}

// The integral of its definition by the trapezoidal rule with 20,000 steps, whose error is below
// 1e-9.
double slow_owens_t(double h, double a) {
  const int steps = 20'000;
  const auto at = [&](double x) { return std::exp(-0.5 * h * h * (1.0 + x * x)) / (1.0 + x * x); };
  double sum = 0.5 * (at(0.0) + at(a));
  for (int i = 1; i < steps; ++i) sum += at(a * i / steps);
  return sum * a / steps / (2.0 * std::numbers::pi);
}

TEST(OwensT, IsTheIntegralOfItsDefinition) {
  for (const double h : {0.0, 0.3, 1.0, 2.5, 5.0, 9.0}) {
    for (const double a : {0.0, 0.01, 0.5, 1.0, 1.5, 4.0})
      EXPECT_NEAR(owens_t(h, a), slow_owens_t(h, a), 2e-9) << h << " " << a;
  }
  EXPECT_NEAR(owens_t(0.0, 1.0), 0.125, 1e-12);
  EXPECT_DOUBLE_EQ(owens_t(0.0, INFINITY), 0.25);
  EXPECT_EQ(owens_t(-1.0, 2.0), owens_t(1.0, 2.0));
  EXPECT_EQ(owens_t(1.0, -2.0), -owens_t(1.0, 2.0));
}

struct Felt {
  Surface surface = sheet(13, 25);
  Level level{8.0, 0.05};
  Belief belief;
  Certainty now;

  Felt() : belief(believed(surface)), now(certainty_of(surface, belief.at_vertices(), level)) {}

  static Belief believed(const Surface& surface) {
    const Phantom phantom(surface, {Disk{.centre_m = {0.0125, 0.025, 0.0}, .radius_m = 0.007}},
                          {.noise = 0.05});
    Random random(3);
    std::vector<Palpation> palpations;
    for (int vertex = 0; vertex < surface.vertex_count(); vertex += 9)
      palpations.push_back(phantom.touch(surface.at_vertex(vertex), random));
    const Prior prior(surface, Metric::Chart, {.length_m = 0.005, .signal_sd = 1.0}, {});
    return Belief(prior, {.noise_sd = 0.1}).condition_on(palpations);
  }
};

// The twin: fields and readings are drawn from the belief itself, the belief is conditioned on
// them, and its new expected error averaged. Each of 400 draws scatters by a few tenths of the
// mean, so four standard errors are well below a tenth of it.
TEST(ExpectedErrorAfter, IsTheMeanOverWhatMayBeFelt) {
  Felt felt;
  felt.level.stddev = 0.0;
  const Marginals marginals = felt.belief.at_vertices();
  felt.now = certainty_of(felt.surface, marginals, felt.level);
  const std::vector<int> stops = {20, 150, 210};
  Random random(5);
  double sum = 0.0;
  const int draws = 400;
  for (int draw = 0; draw < draws; ++draw) {
    Belief grown = felt.belief;
    for (const int stop :
         stops) {  // one after the other: each reading's distribution given those before it
      const std::vector<SurfacePoint> place = {felt.surface.at_vertex(stop)};
      const Marginals here = grown.at(place);
      const double sd = std::sqrt(here.variance[0] + grown.noise_variance());
      const std::vector<Palpation> touch = {
          {.where = place[0], .reading = here.mean[0] + sd * random.normal()}};
      grown = grown.condition_on(touch);
    }
    sum += expected_error(felt.surface, grown.at_vertices(), felt.level).symmetric_difference_m2() /
           draws;
  }
  EXPECT_NEAR(expected_error_after(felt.surface, felt.belief, felt.now, felt.level, stops), sum,
              0.05 * sum);
}

TEST(ExpectedErrorAfter, IsNowsWithoutTouchesAndFallsWithEach) {
  const Felt felt;
  double before = expected_error_after(felt.surface, felt.belief, felt.now, felt.level, {});
  const Marginals marginals = felt.belief.at_vertices();
  EXPECT_NEAR(before, expected_error(felt.surface, marginals, felt.level).symmetric_difference_m2(),
              1e-6 * before);
  std::vector<int> stops;
  for (const int stop : {20, 150, 210, 300}) {
    stops.push_back(stop);
    const double after =
        expected_error_after(felt.surface, felt.belief, felt.now, felt.level, stops);
    EXPECT_LE(after, before);
    before = after;
  }
}

std::string reason_of_a_run(const StopRule& stop, double noise, int batches = 30) {
  const Surface tissue = sheet(26, 51);
  const Phantom phantom(tissue, {Disk{.centre_m = {0.0125, 0.025, 0.0}, .radius_m = 0.006}},
                        {.noise = noise});
  Exploration exploration(tissue, {.level = {.estimate = LevelEstimate::Edge}},
                          {.acquisition = straddle(), .batches = batches, .stop = stop});
  Random random(1);
  run(exploration, [&](const SurfacePoint& where, const Vec3&) {
    return std::optional(phantom.touch(where, random));
  });
  if (stop.band_m > 0.0 && exploration.stop_reason() == "band") {
    EXPECT_LE(exploration.conclusion().certainty->half_width_m, stop.band_m);
  }
  if (exploration.stop_reason() != "budget") {
    EXPECT_LT(exploration.batch(), batches + 1);
  }
  return exploration.stop_reason();
}

TEST(Stopping, ComesWhenTheBandIsNarrowEnough) {
  EXPECT_EQ(reason_of_a_run({.band_m = 0.002}, 0.01), "band");
}

// A disk of 5 mm could hide long after the boundary is known well enough.
TEST(Stopping, DoesNotComeBeforeTheSearchIsDone) {
  const Surface tissue = sheet(26, 51);
  const Phantom phantom(tissue, {Disk{.centre_m = {0.0125, 0.025, 0.0}, .radius_m = 0.006}},
                        {.noise = 0.02});
  const auto run_with = [&](double undetected_m, const Reach& reach) {
    Exploration exploration(tissue, {.level = {.estimate = LevelEstimate::Edge}},
                            {.acquisition = straddle(),
                             .batches = 30,
                             .aim = {.undetected_diameter_m = undetected_m},
                             .stop = {.error_m2 = 15e-6}},
                            reach);
    Random random(3);
    run(exploration, [&](const SurfacePoint& where, const Vec3&) {
      return std::optional(phantom.touch(where, random));
    });
    EXPECT_EQ(exploration.stop_reason(), "expected error");
    return exploration;
  };
  const Exploration no_goal = run_with(0.0, {}), goal = run_with(0.005, {});
  EXPECT_GT(diameter_ruled_out_m(no_goal.conclusion(), 0.95).value_or(1.0), 0.005);
  EXPECT_LE(diameter_ruled_out_m(goal.conclusion(), 0.95).value_or(1.0), 0.005);
  // Where nothing may be touched no touch is waited for.
  Reach but_a_corner{.vertices = std::vector<int>()};
  for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex) {
    if (tissue.vertex(vertex).head<2>().norm() > 0.006) but_a_corner.vertices->push_back(vertex);
  }
  EXPECT_GT(diameter_ruled_out_m(run_with(0.005, but_a_corner).conclusion(), 0.95).value_or(1.0),
            0.005);
}

/// Batches of a run to that error, with drawn outlines asked or not.
int batches_to(double error_m2, std::optional<std::uint64_t> outlines_seed,
               const std::function<void(const Exploration&)>& at_the_end) {
  const Surface tissue = sheet(26, 51);
  const Phantom phantom(tissue, {Disk{.centre_m = {0.0125, 0.025, 0.0}, .radius_m = 0.006}},
                        {.noise = 0.05});
  Exploration exploration(
      tissue, {.level = {.estimate = LevelEstimate::Edge}},
      {.acquisition = straddle(), .batches = 15, .stop = {.error_m2 = error_m2}}, {},
      outlines_seed);
  Random random(3);
  run(exploration, [&](const SurfacePoint& where, const Vec3&) {
    return std::optional(phantom.touch(where, random));
  });
  at_the_end(exploration);
  return exploration.batch();
}

TEST(Stopping, WaitsUntilDrawnOutlinesSayTheSame) {
  constexpr double kError_m2 = 6e-6;
  const int alone = batches_to(kError_m2, std::nullopt, [](const Exploration&) {});
  const int confirmed = batches_to(kError_m2, 7, [&](const Exploration& exploration) {
    ASSERT_EQ(exploration.stop_reason(), "expected error");
    Exploration drawn = exploration, other = exploration;
    drawn.draw_outlines(7);
    EXPECT_LE(drawn.conclusion().certainty->expected_in_all_m2(), kError_m2);
    // The outlines that were drawn to stop are those that are drawn at the end.
    Exploration again(exploration.surface(), exploration.conclusion().model, exploration.plan(), {},
                      7);
    again.take_up(exploration.readings());
    again.draw_outlines(7);
    EXPECT_EQ(again.conclusion().certainty->expected_in_all_m2(),
              drawn.conclusion().certainty->expected_in_all_m2());
    other.draw_outlines(8);
    EXPECT_NE(other.conclusion().certainty->expected_in_all_m2(),
              drawn.conclusion().certainty->expected_in_all_m2());
  });
  EXPECT_GE(confirmed, alone);
}

TEST(Stopping, ComesWhenNothingIsToBeGained) {
  EXPECT_EQ(reason_of_a_run({.least_gain = 0.9}, 0.05), "nothing to gain");
}

TEST(Stopping, ComesWithTheBudgetWhereNothingElseIsAskedFor) {
  EXPECT_EQ(reason_of_a_run({}, 0.05, /*batches=*/5), "budget");
}

TEST(StopRule, RefusesWhatIsNone) {
  EXPECT_THROW(check(StopRule{.error_m2 = -1.0}), InvalidInput);
  EXPECT_THROW(check(StopRule{.band_m = std::nan("")}), InvalidInput);
  EXPECT_THROW(check(StopRule{.least_gain = 1.5}), InvalidInput);
  EXPECT_THROW(check(Model{.band = Band{.probability = 1.0}}), InvalidInput);
}

}  // namespace
}  // namespace palpation
