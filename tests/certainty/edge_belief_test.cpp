#include "palpation/certainty/edge_belief.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "certainty/edge_fit.h"
#include "palpation/base/error.h"
#include "palpation/base/random.h"
#include "palpation/boundary/level_set.h"
#include "palpation/certainty/certainty.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

constexpr double kRadius_m = 0.006;
constexpr double kLow = 7.0, kHigh = 9.0, kSlope = 1400.0;

Surface tissue() {
  Random random(0);
  return Surface(make_plane({.size_m = {0.025, 0.025}, .columns = 51, .rows = 51}, random));
}

double depth_in_disk(const Vec3& place) {
  return kRadius_m - (place - Vec3(0.0125, 0.0125, 0.0)).norm();
}

double stiffness(const Vec3& place) {
  return kLow + (kHigh - kLow) / (1.0 + std::exp(-kSlope * depth_in_disk(place)));
}

/// A belief of a disk from readings at random vertices, more of them near its edge.
Belief belief_of_disk(const Surface& surface, double noise_sd, int count, Random& random) {
  Belief belief(Prior(surface, Metric::Chart, Kernel{.length_m = 0.0045, .signal_sd = 1.0}),
                {.noise_sd = noise_sd});
  std::vector<Palpation> palpations;
  while (static_cast<int>(palpations.size()) < count) {
    const auto vertex = static_cast<int>(random.uniform() * surface.vertex_count());
    const Vec3 place = surface.vertex(vertex);
    if (palpations.size() % 4 != 0 && std::abs(depth_in_disk(place)) > 0.0015) continue;
    palpations.push_back({.where = surface.at_vertex(vertex),
                          .reading = stiffness(place) + noise_sd * random.normal()});
  }
  return belief.condition_on(palpations);
}

constexpr double kFirstLevels[] = {8.0};

EdgeBelief edge_of(const Belief& belief) {
  return EdgeBelief::around(belief, belief.at_vertices(), kFirstLevels, 0.5).value();
}

double wrong_area_m2(const Surface& surface, const Field& depth) {
  double area = 0.0;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    if ((depth[vertex] >= 0.0) != (depth_in_disk(surface.vertex(vertex)) >= 0.0))
      area += surface.vertex_areas()[vertex];
  }
  return area;
}

TEST(EdgeBelief, KnowsHowWrongItIs) {
  const Surface surface = tissue();
  Random random(1);
  double wrong = 0.0, expected = 0.0;
  for (int trial = 0; trial < 20; ++trial) {
    const EdgeBelief edge = edge_of(belief_of_disk(surface, 0.1, 80, random));
    wrong += wrong_area_m2(surface, edge.depth());
    expected += edge.expected_error_m2();
  }
  EXPECT_GT(wrong / expected, 0.6);
  EXPECT_LT(wrong / expected, 1.5);
}

TEST(EdgeBelief, KnowsWhatIsFeltAtABoundaryThatLiesLowerThanHalfWayUp) {
  const Surface surface = tissue();
  Random random(2);
  const Belief belief = belief_of_disk(surface, 0.02, 100, random);
  const EdgeBelief edge =
      EdgeBelief::around(belief, belief.at_vertices(), kFirstLevels, 0.3).value();
  EXPECT_NEAR(share_at_depth(edge.profile(), 0.0), 0.3, 1e-9);
  for (const Palpation& one : belief.palpations()) {
    const double share =
        share_at_depth(edge.profile(), surface.interpolate(edge.depth(), one.where));
    EXPECT_NEAR(edge.profile().low + share * (edge.profile().high - edge.profile().low),
                one.reading, 0.2);
  }
}

// What a field learns as noise where it cannot follow an edge: five times what there is.
TEST(EdgeBelief, TakesBackANoiseThatWasLearnedAndIsNotThere) {
  const Surface surface = tissue();
  Random random(8);
  std::vector<Palpation> palpations = belief_of_disk(surface, 0.1, 100, random).palpations();
  const auto around = [&](double noise_log_sd) {
    const Belief belief =
        Belief(Prior(surface, Metric::Chart, Kernel{.length_m = 0.0045, .signal_sd = 1.0}),
               {.noise_sd = 0.5});
    const Belief known = belief.condition_on(palpations);
    return EdgeBelief::around(known, known.at_vertices(), kFirstLevels, 0.5, {}, noise_log_sd)
        .value();
  };
  const EdgeBelief given = around(0.0), learned = around(0.07);
  EXPECT_EQ(given.noise_variance(), 0.25);
  EXPECT_GT(learned.noise_variance(), 0.5 * 0.01);
  EXPECT_LT(learned.noise_variance(), 2.0 * 0.01);
  EXPECT_LT(learned.expected_error_m2(), 0.4 * given.expected_error_m2());
  for (Palpation& palpation : palpations) palpation.noise_variance = 0.25;  // each says so itself
  EXPECT_EQ(around(0.07).noise_variance(), 0.25);
}

TEST(EdgeBelief, KnowsTheLevelWithinItsStandardDeviation) {
  const Surface surface = tissue();
  Random random(2);
  double squares = 0.0;
  constexpr int kTrials = 30;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Level level = edge_of(belief_of_disk(surface, 0.1, 80, random)).level();
    squares += std::pow((level.value - 8.0) / *level.stddev, 2) / kTrials;
  }
  EXPECT_GT(squares, 0.4);
  EXPECT_LT(squares, 2.0);
}

TEST(EdgeBelief, LearnsMoreFromItsOwnPicksThanFromTouchesAtRandom) {
  const Surface surface = tissue();
  Random random(4);
  const Belief belief = belief_of_disk(surface, 0.1, 40, random);
  const Marginals marginals = belief.at_vertices();
  const EdgeBelief edge = edge_of(belief);
  std::vector<int> all(static_cast<std::size_t>(surface.vertex_count()));
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex)
    all[static_cast<std::size_t>(vertex)] = vertex;
  // A reading that comes as expected leaves the most probable boundary where it is, and only makes
  // it surer.
  const auto left_with = [&](const std::vector<int>& vertices) {
    std::vector<Palpation> supposed;
    for (const int vertex : vertices) {
      const double share =
          1.0 / (1.0 + std::exp(-edge.profile().slope_per_m * edge.depth()[vertex]));
      supposed.push_back(
          {.where = surface.at_vertex(vertex),
           .reading = edge.profile().low + share * (edge.profile().high - edge.profile().low)});
    }
    return EdgeBelief::around(belief.condition_on(supposed), marginals, kFirstLevels, 0.5)
        ->expected_error_m2();
  };
  const std::vector<int> picks = edge.most_telling(all, 6, 0.0005, marginals.variance);
  ASSERT_EQ(picks.size(), 6u);
  const double left = left_with(picks);
  EXPECT_LT(left, 0.9 * edge.expected_error_m2());
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<int> others;
    while (others.size() < picks.size()) {
      const auto vertex = static_cast<int>(random.uniform() * surface.vertex_count());
      if (std::abs(edge.depth()[vertex]) < 0.003) others.push_back(vertex);
    }
    EXPECT_LT(left, left_with(others));
  }
}

TEST(EdgeBelief, PicksAreApartAndAmongTheCandidates) {
  const Surface surface = tissue();
  Random random(5);
  const Belief belief = belief_of_disk(surface, 0.1, 40, random);
  const EdgeBelief edge = edge_of(belief);
  std::vector<int> some;
  for (int vertex = 0; vertex < surface.vertex_count(); vertex += 3) some.push_back(vertex);
  const std::vector<int> picks = edge.most_telling(some, 10, 0.002, belief.at_vertices().variance);
  ASSERT_EQ(picks.size(), 10u);
  for (std::size_t i = 0; i < picks.size(); ++i) {
    EXPECT_EQ(picks[i] % 3, 0);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE((surface.vertex(picks[i]) - surface.vertex(picks[j])).norm(), 0.002);
  }
  EXPECT_TRUE(edge.most_telling({}, 10, 0.002, belief.at_vertices().variance).empty());
}

TEST(EdgeBelief, BandWidensWithItsProbability) {
  const Surface surface = tissue();
  Random random(6);
  const EdgeBelief edge = edge_of(belief_of_disk(surface, 0.1, 80, random));
  const Certainty likely = certainty_of(surface, edge, 0.5),
                  sure = certainty_of(surface, edge, 0.99);
  EXPECT_LT(likely.band_score, sure.band_score);
  EXPECT_LT(likely.half_width_m, sure.half_width_m);
  // A band for the whole outline is wider than that of one place.
  EXPECT_GT(sure.band_score, 2.5758);
}

TEST(EdgeBelief, BandWidensWithWhatIsNotKnownOfTheNoise) {
  const Surface surface = tissue();
  Random random(6);
  const Belief belief = belief_of_disk(surface, 0.1, 80, random);
  const auto score_with = [&](double noise_log_sd) {
    return EdgeBelief::around(belief, belief.at_vertices(), kFirstLevels, 0.5, {}, noise_log_sd)
        ->band_score(0.95);
  };
  const double known = score_with(0.0), of_many = score_with(learned_noise_log_sd(105)),
               of_few = score_with(learned_noise_log_sd(15));
  EXPECT_DOUBLE_EQ(score_with(1e-9), known);
  // As Student's distribution is wider than the normal one, three standard deviations out: 2 to 4 %
  // with 105 readings.
  EXPECT_GT(of_many, 1.015 * known);
  EXPECT_LT(of_many, 1.045 * known);
  EXPECT_GT(of_few, 1.1 * known);
  EXPECT_THROW(score_with(-1.0), InvalidInput);
}

TEST(EdgeBelief, IsNothingWhereNoBoundaryCanBeDrawn) {
  const Surface surface = tissue();
  const Belief blank(Prior(surface, Metric::Chart, Kernel{}), {.noise_sd = 0.1});
  EXPECT_FALSE(EdgeBelief::around(blank, blank.at_vertices(), kFirstLevels, 0.5));
  const Palpation one{.where = surface.at_vertex(0), .reading = 7.0};
  const Belief single = blank.condition_on(std::span(&one, 1));
  EXPECT_FALSE(EdgeBelief::around(single, single.at_vertices(), kFirstLevels, 0.5));
  EXPECT_THROW(EdgeBelief::around(single, single.at_vertices(), kFirstLevels, 1.0), InvalidInput);
}

/// The most probable corrections and profile have no better neighbours: checked on the posterior
/// density itself, written out.
TEST(FitEdgeBelief, EndsWhereThePosteriorDensityIsGreatest) {
  const Surface surface = tissue();
  Random random(7);
  const Prior correction(
      surface, Metric::Chart,
      Kernel{.family = KernelFamily::Matern52, .length_m = 0.009, .signal_sd = 0.001}, {.sd = 0.0});
  EdgeData data;
  const int count = 12;
  data.reading.resize(count);
  data.variance = Eigen::VectorXd::Constant(count, 0.01);
  data.depth_m.resize(count);
  data.part.assign(count, 0);
  for (int i = 0; i < count; ++i) {
    const auto vertex = static_cast<int>(random.uniform() * surface.vertex_count());
    data.places.push_back(surface.at_vertex(vertex));
    data.depth_m[i] = -0.0025 + 0.005 * i / (count - 1.0);
    data.reading[i] = kLow +
                      (kHigh - kLow) / (1.0 + std::exp(-kSlope * (data.depth_m[i] + 0.0003))) +
                      0.1 * random.normal();
  }
  const Eigen::MatrixXd covariance = correction.covariance(data.places, data.places);
  const ProfilePrior prior{Eigen::Vector3d(7.0, 9.0, std::log(1200.0)),
                           Eigen::Vector3d(4.0, 4.0, 0.25)};
  const EdgeFit fit = fit_edge_belief(data, covariance, prior);
  const Eigen::MatrixXd precision = covariance.inverse();
  const auto misfit = [&](const ProfileParameters& profile, const Eigen::VectorXd& offset) {
    double sum = offset.dot(precision * offset) +
                 ((profile - prior.mean).array().square() / prior.variance.array()).sum();
    for (int i = 0; i < count; ++i) {
      const double share =
          1.0 / (1.0 + std::exp(-std::exp(profile[2]) * (data.depth_m[i] + offset[i])));
      sum += std::pow(data.reading[i] - profile[0] - share * (profile[1] - profile[0]), 2) /
             data.variance[i];
    }
    return sum;
  };
  const double least = misfit(fit.profile, fit.correction_m);
  for (int trial = 0; trial < 200; ++trial) {
    ProfileParameters profile = fit.profile;
    for (int i = 0; i < 3; ++i) profile[i] += 0.01 * random.normal();
    Eigen::VectorXd weights(count);
    for (double& weight : weights) weight = random.normal();
    const Eigen::VectorXd offset = fit.correction_m + 3e-2 * covariance * weights / 0.001;
    EXPECT_GE(misfit(profile, offset), least - 1e-6);
  }
}

}  // namespace
}  // namespace palpation
