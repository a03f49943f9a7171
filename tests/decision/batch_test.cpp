#include "palpation/decision/batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "belief/tissue.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

std::vector<int> all_vertices(const Surface& surface) {
  std::vector<int> vertices(static_cast<std::size_t>(surface.vertex_count()));
  std::iota(vertices.begin(), vertices.end(), 0);
  return vertices;
}

Belief believed(const Surface& surface, int readings, std::uint64_t seed) {
  Random random(seed);
  return Belief(Prior(surface, Metric::Chart, {}), {.noise_sd = 0.1})
      .condition_on(bumpy_readings(surface, readings, random));
}

/// The same batch by conditioning whole beliefs on each pick at its mean: slow and obviously right.
std::vector<int> batch_by_conditioning(Belief belief, const Pointwise& acquisition,
                                       const Level& level, int size) {
  std::vector<int> picks;
  const Field mean = belief.at_vertices().mean;
  for (int i = 0; i < size; ++i) {
    const Field variance = belief.at_vertices().variance;
    int best = 0;
    double best_score = -1e300;
    for (int vertex = 0; vertex < mean.size(); ++vertex) {
      const double score = acquisition.score(mean[vertex], std::sqrt(variance[vertex]), level);
      if (score > best_score) {
        best_score = score;
        best = vertex;
      }
    }
    picks.push_back(best);
    const Palpation supposed = touch(belief.prior().surface(), best, mean[best]);
    belief = belief.condition_on(std::span(&supposed, 1));
  }
  return picks;
}

const Level kLevel{8.0, std::nullopt};

TEST(Acquisition, IsWhatThePaperWrites) {
  EXPECT_DOUBLE_EQ(evr().score(7.0, 0.5, kLevel), 0.5);
  EXPECT_DOUBLE_EQ(ucb(0.25).score(7.0, 0.5, kLevel), 0.25 * 7.0 + 0.75 * 0.5);
  EXPECT_DOUBLE_EQ(ils_ucb(0.25).score(7.0, 0.5, kLevel), 0.75 * 0.5 - 0.25 * 1.0);
  EXPECT_DOUBLE_EQ(straddle().score(7.0, 0.5, kLevel), 1.96 * 0.5 - 1.0);
  EXPECT_DOUBLE_EQ(lse_ambiguity(3.0).score(7.0, 0.5, kLevel), 0.5);
  EXPECT_THROW(ils_ucb(1.5), InvalidInput);
}

TEST(Acquisition, MaxScalingDividesBothTermsByTheirMaxima) {
  const Surface tissue = plane(20, 40);
  const Belief belief = believed(tissue, 20, 1);
  const Marginals marginals = belief.at_vertices();
  const Field scores = score(ils_ucb(0.5, Scaling::MaxScaled), belief, kLevel);
  const double greatest_sd = std::sqrt(marginals.variance.maxCoeff());
  const double greatest_distance = (marginals.mean.array() - 8.0).abs().maxCoeff();
  for (int vertex : {0, 100, 799}) {
    const double expected = 0.5 * std::sqrt(marginals.variance[vertex]) / greatest_sd -
                            0.5 * std::abs(marginals.mean[vertex] - 8.0) / greatest_distance;
    EXPECT_NEAR(scores[vertex], expected, 1e-14);
  }
}

TEST(ChooseBatch, EqualsConditioningOnEachPickAtItsMean) {
  const Surface tissue = plane(20, 40, 0.3);
  for (int readings : {6, 30, 80}) {
    const Belief belief = believed(tissue, readings, 2);
    for (const Pointwise& acquisition : {evr(), ucb(0.5), ils_ucb(0.5), straddle()}) {
      const Batch batch =
          choose_batch(belief, acquisition, kLevel, all_vertices(tissue), {.size = 10});
      EXPECT_EQ(batch.vertices, batch_by_conditioning(belief, acquisition, kLevel, 10));
    }
  }
}

TEST(ChooseBatch, PicksTheSameLazilyAndExhaustively) {
  const Surface tissue = plane(40, 80, 0.3);
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const Belief belief = believed(tissue, 10 + 12 * static_cast<int>(seed), seed);
    for (const Scaling scaling : {Scaling::Raw, Scaling::MaxScaled}) {
      for (const Pointwise& acquisition :
           {evr(), ucb(0.3, scaling), ils_ucb(0.5, scaling), straddle(), lse_ambiguity()}) {
        for (const double spacing : {0.0, 0.002}) {
          BatchOptions options{
              .size = 12, .least_spacing_m = spacing, .evaluation = Evaluation::Lazy};
          const Batch lazy =
              choose_batch(belief, acquisition, kLevel, all_vertices(tissue), options);
          options.evaluation = Evaluation::Exhaustive;
          const Batch exhaustive =
              choose_batch(belief, acquisition, kLevel, all_vertices(tissue), options);
          EXPECT_EQ(lazy.vertices, exhaustive.vertices);
          EXPECT_EQ(lazy.scores, exhaustive.scores);
          EXPECT_LT(lazy.evaluations, exhaustive.evaluations);
        }
      }
    }
  }
}

TEST(ChooseBatch, KeepsItsDistanceAndItsCandidates) {
  const Surface tissue = plane(40, 80);
  const Belief belief = believed(tissue, 30, 3);
  std::vector<int> even;
  for (int vertex = 0; vertex < tissue.vertex_count(); vertex += 2) even.push_back(vertex);
  const Batch batch =
      choose_batch(belief, ils_ucb(), kLevel, even, {.size = 20, .least_spacing_m = 0.003});
  ASSERT_EQ(batch.vertices.size(), 20u);
  for (std::size_t i = 0; i < batch.vertices.size(); ++i) {
    EXPECT_EQ(batch.vertices[i] % 2, 0);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE((tissue.vertex(batch.vertices[i]) - tissue.vertex(batch.vertices[j])).norm(),
                0.003);
  }
}

TEST(ChooseBatch, GivesTiesToTheLowestVertex) {
  // Nothing is known and nothing distinguishes one vertex from another.
  const Surface tissue = plane(10, 20);
  const Belief nothing(Prior(tissue, Metric::Chart, {}), {.noise_sd = 0.1});
  const Pointwise constant{.score = [](double, double, const Level&) { return 1.0; },
                           .grows_with_stddev = true};
  for (const Evaluation evaluation : {Evaluation::Lazy, Evaluation::Exhaustive}) {
    EXPECT_EQ(choose_batch(nothing, constant, kLevel, all_vertices(tissue),
                           {.size = 4, .least_spacing_m = 1e-6, .evaluation = evaluation})
                  .vertices,
              (std::vector{0, 1, 2, 3}));
    EXPECT_EQ(choose_batch(nothing, constant, kLevel, all_vertices(tissue),
                           {.size = 2, .evaluation = evaluation})
                  .vertices,
              (std::vector{0, 0}));
  }
}

TEST(ChooseBatch, TakesAnAcquisitionOfTheWholeBelief) {
  const Surface tissue = plane(20, 40);
  const Belief belief = believed(tissue, 30, 4);
  // EVR written as a criterion of the whole belief must pick what EVR picks.
  const Whole whole{.scores = [](const Belief& now, const Level&) {
    return Field(now.at_vertices().variance.cwiseSqrt());
  }};
  EXPECT_EQ(choose_batch(belief, whole, kLevel, all_vertices(tissue), {.size = 6}).vertices,
            choose_batch(belief, evr(), kLevel, all_vertices(tissue), {.size = 6}).vertices);
}

TEST(ChooseBatch, TouchesAtRandomTheSameWayForTheSameSeed) {
  const Surface tissue = plane(20, 40);
  const Belief belief = believed(tissue, 30, 5);
  const auto picks = [&](std::uint64_t seed) {
    return choose_batch(belief, random_scores(seed), kLevel, all_vertices(tissue), {.size = 8})
        .vertices;
  };
  EXPECT_EQ(picks(1), picks(1));
  EXPECT_NE(picks(1), picks(2));
}

TEST(ChooseBatch, RunsOutOfCandidates) {
  const Surface tissue = plane(10, 20);
  const Belief belief = believed(tissue, 10, 6);
  const std::vector<int> two{5, 17};
  EXPECT_EQ(choose_batch(belief, evr(), kLevel, two, {.size = 10, .least_spacing_m = 1e-6})
                .vertices.size(),
            2u);
  EXPECT_TRUE(choose_batch(belief, evr(), kLevel, {}, {.size = 10}).vertices.empty());
}

TEST(ChooseBatch, RefusesScoresThatAreNotNumbers) {
  const Surface tissue = plane(10, 20);
  const Belief belief = believed(tissue, 10, 7);
  const Pointwise wrong{.score = [](double, double, const Level&) { return std::nan(""); }};
  EXPECT_THROW(choose_batch(belief, wrong, kLevel, all_vertices(tissue), {}), InvalidInput);
  EXPECT_THROW(
      choose_batch(belief, wrong, kLevel, all_vertices(tissue), {.evaluation = Evaluation::Lazy}),
      InvalidInput);
}

/// batch_by_conditioning with readings on the way: each a palpation of its own, twice as precise
/// where they are 1 mm apart, since they stand 2 mm apart.
std::vector<int> batch_on_the_way(Belief belief, const Pointwise& acquisition, const Vec3& from,
                                  int size) {
  const Surface surface = belief.prior().surface();
  const Field mean = belief.at_vertices().mean;
  const double noise_variance = belief.noise_variance();
  std::vector<Vec3> places{from};
  std::vector<int> picks;
  for (int i = 0; i < size; ++i) {
    const Field variance = belief.at_vertices().variance;
    int best = 0;
    for (int vertex = 1; vertex < mean.size(); ++vertex) {
      const auto score = [&](int v) {
        return acquisition.score(mean[v], std::sqrt(variance[v]), kLevel);
      };
      if (score(vertex) > score(best)) best = vertex;
    }
    const Vec3 end = surface.vertex(best);
    Vec3 start = places.front();
    for (const Vec3& place : places) {
      if ((place - end).norm() < (start - end).norm()) start = place;
    }
    std::vector<Palpation> supposed;
    for (int step = 1; 0.002 * step < (end - start).norm(); ++step) {
      const Vec3 place = start + 0.002 * step * (end - start).normalized();
      const int nearest = surface.nearest_vertex(place);
      supposed.push_back(touch(surface, nearest, mean[nearest]));
      supposed.back().noise_variance = 0.5 * noise_variance;
    }
    supposed.push_back(touch(surface, best, mean[best]));
    belief = belief.condition_on(supposed);
    places.push_back(end);
    picks.push_back(best);
  }
  return picks;
}

TEST(ChooseBatch, CountsTheReadingsOnTheWayBeforeTheyAreMade) {
  const Surface tissue = plane(20, 40, 0.3);
  for (int readings : {6, 40}) {
    const Belief belief = believed(tissue, readings, 2);
    const Vec3 from = tissue.vertex(7);
    for (const Pointwise& acquisition : {evr(), ils_ucb(0.5), straddle()}) {
      BatchOptions options{.size = 8, .way_reading_m = 0.001, .from = tissue.at_vertex(7)};
      const Batch batch = choose_batch(belief, acquisition, kLevel, all_vertices(tissue), options);
      EXPECT_EQ(batch.vertices, batch_on_the_way(belief, acquisition, from, 8));
      options.way_reading_m = 0.0;  // a place alone changes nothing
      EXPECT_EQ(
          choose_batch(belief, acquisition, kLevel, all_vertices(tissue), options).vertices,
          choose_batch(belief, acquisition, kLevel, all_vertices(tissue), {.size = 8}).vertices);
    }
    const Whole whole{.scores = [](const Belief& now, const Level&) {
      return Field(now.at_vertices().variance.cwiseSqrt());
    }};
    EXPECT_EQ(choose_batch(belief, whole, kLevel, all_vertices(tissue),
                           {.size = 6, .way_reading_m = 0.001, .from = tissue.at_vertex(7)})
                  .vertices,
              batch_on_the_way(belief, evr(), from, 6));
  }
}

}  // namespace
}  // namespace palpation
