// The fast ways to a posterior against the dense formulas: in one pass, in many, foreseen, and
// without keeping anything.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "belief/dense.h"
#include "belief/look_ahead.h"
#include "belief/tissue.h"
#include "palpation/base/error.h"
#include "palpation/base/parallel.h"
#include "palpation/belief/belief.h"

namespace palpation {
namespace {

std::vector<Palpation> readings_around_zero(const Surface& tissue, int count) {
  Random random(11);
  std::vector<Palpation> readings = bumpy_readings(tissue, count, random);
  for (Palpation& reading : readings) reading.reading -= 8.0;
  return readings;
}

Belief in_batches(Belief belief, std::span<const Palpation> readings, std::size_t size) {
  for (std::size_t i = 0; i < readings.size(); i += size)
    belief = belief.condition_on(readings.subspan(i, std::min(size, readings.size() - i)));
  return belief;
}

TEST(AppendedRows, AreThoseOfADenseFactorHoweverTheyCame) {
  // 301 sites: more than the 256 columns that are taken at a time; 27 x 33 vertices: no whole
  // number of tiles.
  const Surface tissue = plane(27, 33, 0.3);
  const std::vector<Palpation> readings = readings_around_zero(tissue, 301);
  for (const KernelFamily family : {KernelFamily::SquaredExponential, KernelFamily::Matern12,
                                    KernelFamily::Matern32, KernelFamily::Matern52}) {
    const Prior prior(tissue, Metric::Ambient,
                      {.family = family, .length_m = 0.004, .signal_sd = 1.3}, {.sd = 0.0});
    const Dense dense = dense_posterior(prior, readings, 0.01);
    const Belief blank(prior, {.noise_sd = 0.1});
    // The matrix' condition number is about 1e4.
    for (const std::size_t size : {301, 100, 10})
      expect_alike(in_batches(blank, readings, size).at_vertices(), dense, 1e-11);
    expect_alike(marginals_once(prior, blank.options(), readings), dense, 1e-11);
  }
}

TEST(AppendedRows, DoNotDependOnHowVerticesAreNumbered) {
  const Surface tissue = plane(21, 34, 0.3);
  std::vector<int> order(
      static_cast<std::size_t>(tissue.vertex_count()));  // new number of each vertex
  std::iota(order.begin(), order.end(), 0);
  Random random(5);
  for (int i = static_cast<int>(order.size()) - 1; i > 0; --i)
    std::swap(order[i], order[random.below(i + 1)]);
  TriangleMesh mesh = tissue.mesh();
  for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex)
    mesh.vertices.row(order[vertex]) = tissue.mesh().vertices.row(vertex);
  for (auto face : mesh.triangles.rowwise()) {
    for (int& corner : face) corner = order[corner];
  }
  const Surface shuffled(mesh);
  const std::vector<Palpation> readings = readings_around_zero(tissue, 60);
  std::vector<Palpation> same;
  for (const Palpation& reading : readings) {
    Eigen::Index corner = 0;
    reading.where.barycentric.maxCoeff(&corner);
    same.push_back(
        touch(shuffled, order[tissue.triangle(reading.where.face)[corner]], reading.reading));
  }
  const auto posterior = [](const Surface& surface, std::span<const Palpation> felt) {
    return in_batches(
               Belief(Prior(surface, Metric::Ambient, {.length_m = 0.004}), {.noise_sd = 0.1}),
               felt, 25)
        .at_vertices();
  };
  const Marginals a = posterior(tissue, readings), b = posterior(shuffled, same);
  for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex) {
    EXPECT_EQ(a.mean[vertex], b.mean[order[vertex]]);
    EXPECT_EQ(a.variance[vertex], b.variance[order[vertex]]);
  }
}

TEST(AppendedRows, AreTheSameBytesOnOneThreadAndOnTwo) {
  const Surface tissue = plane(61, 71, 0.3);
  const std::vector<Palpation> readings = readings_around_zero(tissue, 80);
  const Belief blank(Prior(tissue, Metric::Chart, {.length_m = 0.004}), {.noise_sd = 0.1});
  const auto all_ways = [&](int threads) {
    const int before = thread_count();
    set_thread_count(threads);
    const Belief grown = in_batches(blank, readings, 30);
    std::vector<Marginals> found = {grown.at_vertices(),
                                    marginals_once(blank.prior(), blank.options(), readings)};
    const std::vector<SurfacePoint> ahead = {tissue.at_vertex(1), tissue.at_vertex(2000)};
    const std::vector<Palpation> felt = {touch(tissue, 1, 0.3), touch(tissue, 2000, 0.1)};
    found.push_back(grown.foresee(ahead).condition_on(felt).at_vertices());
    set_thread_count(before);
    return found;
  };
  const std::vector<Marginals> one = all_ways(1), two = all_ways(2);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_TRUE(one[i].mean == two[i].mean);
    EXPECT_TRUE(one[i].variance == two[i].variance);
  }
}

/// Touches of three places again and again, each with a reading of its own.
std::vector<Palpation> of_three_places(const Surface& tissue, int count) {
  std::vector<Palpation> readings;
  for (int i = 0; i < count; ++i) readings.push_back(touch(tissue, 100 + 7 * (i % 3), std::sin(i)));
  return readings;
}

TEST(TouchedAgain, IsARowMoreAndLeavesThoseThatStand) {
  const Surface tissue = plane(27, 33, 0.3);
  const Prior prior(tissue, Metric::Ambient, {.length_m = 0.004});
  std::vector<Palpation> readings = readings_around_zero(tissue, 60);
  for (const Palpation& again : of_three_places(tissue, 9)) readings.push_back(again);
  for (const double noise_sd : {0.1, 0.002}) {
    const Dense dense = dense_posterior(prior, readings, noise_sd * noise_sd);
    const Belief grown = in_batches(Belief(prior, {.noise_sd = noise_sd}), readings, 3);
    EXPECT_EQ(grown.site_count(), 69);
    expect_alike(grown.at_vertices(), dense, noise_sd == 0.1 ? 1e-11 : 1e-9);
    expect_alike(marginals_once(prior, grown.options(), readings), dense,
                 noise_sd == 0.1 ? 1e-11 : 1e-9);
    EXPECT_NEAR(grown.log_marginal_likelihood() / dense.log_likelihood, 1.0, 1e-9);
  }
}

TEST(TouchedAgain, IsMergedWhereRepeatsAreMostOfAllRows) {
  const Surface tissue = plane(27, 33, 0.3);
  const Prior prior(tissue, Metric::Ambient, {.length_m = 0.004});
  const std::vector<Palpation> readings = of_three_places(tissue, 200);
  const Belief grown = in_batches(Belief(prior, {.noise_sd = 0.1}), readings, 1);
  EXPECT_LE(grown.site_count(), 6);
  expect_alike(grown.at_vertices(), dense_posterior(prior, readings, 0.01), 1e-11);
}

TEST(TouchedAgain, IsMergedWhereRowsOfOnePlaceWouldAllButCoincide) {
  const Surface tissue = plane(27, 33, 0.3);
  const Prior prior(tissue, Metric::Ambient, {.length_m = 0.004}, {.sd = 0.0});
  std::vector<Palpation> readings = readings_around_zero(tissue, 20);
  readings.push_back(readings[4]);
  const Belief grown = in_batches(Belief(prior, {.noise_sd = 1e-5}), readings, 5);
  EXPECT_EQ(grown.site_count(), 20);
  expect_alike(grown.at_vertices(),
               Belief(prior, {.noise_sd = 1e-5}).condition_on(readings).at_vertices(), 1e-10);
}

class Foresight : public ::testing::Test {
 protected:
  Foresight()
      : before(in_batches(Belief(prior(), {.noise_sd = 0.1}), std::span(readings).first(30), 10)) {
    for (std::size_t i = 30; i < 40; ++i) planned.push_back(readings[i].where);
  }

  Prior prior() const {
    return Prior(tissue, Metric::Chart, {.length_m = 0.004}, {},
                 slope_across(tissue, Metric::Chart, 0.5));
  }
  std::span<const Palpation> felt() const { return std::span(readings).subspan(30); }

  Surface tissue = plane(31, 41, 0.3);
  std::vector<Palpation> readings = readings_around_zero(tissue, 40);
  Belief before;
  std::vector<SurfacePoint> planned;
};

TEST_F(Foresight, ChangesNothingBeforeTheTouches) {
  expect_alike(before.foresee(planned).at_vertices(), before.at_vertices(), 0.0);
}

TEST_F(Foresight, IsAFullUpdateOnceTheyAreFelt) {
  const Belief plain = before.condition_on(felt()),
               quick = before.foresee(planned).condition_on(felt());
  expect_alike(quick.at_vertices(), plain.at_vertices(), 1e-12);
  EXPECT_EQ(quick.log_marginal_likelihood(), plain.log_marginal_likelihood());
  const Palpation later = touch(tissue, 5, 0.2);
  expect_alike(quick.condition_on(std::span(&later, 1)).at_vertices(),
               plain.condition_on(std::span(&later, 1)).at_vertices(), 1e-12);
}

TEST_F(Foresight, IsOfFirstTouchesToo) {
  const Belief blank(prior(), {.noise_sd = 0.1});
  expect_alike(blank.foresee(planned).condition_on(felt()).at_vertices(),
               blank.condition_on(felt()).at_vertices(), 1e-12);
}

TEST_F(Foresight, IsLeftAsideWhereTheRobotDoesOtherwise) {
  const Belief ready = before.foresee(planned);
  std::vector<Palpation> swapped(felt().begin(), felt().end()), exact = swapped, fewer = swapped,
                                                                more = swapped, again = swapped;
  std::swap(swapped[2], swapped[7]);
  exact[4].noise_variance = 1e-6;
  fewer.pop_back();
  more.push_back(touch(tissue, 7, 0.1));
  again[0] = readings[3];
  for (const auto& other : {swapped, exact, fewer, more, again}) {
    expect_alike(ready.condition_on(other).at_vertices(), before.condition_on(other).at_vertices(),
                 1e-12);
  }
}

TEST_F(Foresight, IsOfPlacesTouchedBeforeToo) {
  planned[3] = readings[2].where;
  std::vector<Palpation> felt_there(felt().begin(), felt().end());
  felt_there[3].where = planned[3];
  expect_alike(before.foresee(planned).condition_on(felt_there).at_vertices(),
               before.condition_on(felt_there).at_vertices(), 1e-12);
}

TEST_F(Foresight, OfNothingOrOfAPlaceTwiceIsNone) {
  const std::vector<SurfacePoint> twice = {planned[0], planned[1], planned[0]};
  for (const auto& places : {std::vector<SurfacePoint>{}, twice}) {
    expect_alike(before.foresee(places).condition_on(felt()).at_vertices(),
                 before.condition_on(felt()).at_vertices(), 1e-12);
  }
}

// The signal of standardized readings is known when they are felt: nothing that is supposed before
// may be refused for it.
TEST_F(Foresight, OfStandardizedReadingsOfGivenNoiseIsNone) {
  const BeliefOptions options{.noise_sd = 0.5, .standardize = true, .single_precision = true};
  for (const Belief& belief :
       {Belief(prior(), options),
        in_batches(Belief(prior(), options), std::span(readings).first(30), 10)}) {
    expect_alike(belief.foresee(planned).condition_on(felt()).at_vertices(),
                 belief.condition_on(felt()).at_vertices(), 0.0);
  }
}

TEST(LookAhead, EqualsConditioningWhateverTilesAreAskedInBetween) {
  const Surface tissue = plane(27, 33, 0.3);
  const std::vector<Palpation> readings = readings_around_zero(tissue, 40);
  const Prior prior(tissue, Metric::Ambient, {.length_m = 0.004}, {},
                    slope_across(tissue, Metric::Ambient, 0.5));
  Belief belief = in_batches(Belief(prior, {.noise_sd = 0.1}), readings, 15);
  LookAhead ahead(belief, belief.at_vertices().variance);
  std::vector<Palpation> supposed;
  for (const int vertex : {3, 100, 101, 850, 3, 400}) {
    ahead.touch(vertex, 0.02);
    supposed.push_back(touch(tissue, vertex, 0.0));
    supposed.back().noise_variance = 0.02;
    ahead.bring_up_to_date(
        ahead.tile_of(vertex + 1));  // some tiles know of some touches, others of none
  }
  const Field left = belief.condition_on(supposed).at_vertices().variance;
  for (int tile = 0; tile < ahead.tile_count(); ++tile) {
    ahead.bring_up_to_date(tile);
    EXPECT_TRUE(ahead.is_current(tile));
    for (std::size_t i = 0; i < ahead.vertices(tile).size(); ++i)
      EXPECT_NEAR(ahead.variances(tile)[i], left[ahead.vertices(tile)[i]], 1e-12);
  }
  EXPECT_THROW(ahead.touch(tissue.vertex_count(), 0.0), InvalidInput);
}

}  // namespace
}  // namespace palpation
