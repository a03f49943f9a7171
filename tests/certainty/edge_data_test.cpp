#include "certainty/edge_data.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "palpation/base/random.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

Surface tissue() {
  Random random(0);
  return Surface(make_plane({.size_m = {0.04, 0.05}, .columns = 41, .rows = 51}, random));
}

Belief felt(const Surface& surface, int count, double high, double noise) {
  Random random(1);
  std::vector<Palpation> palpations;
  for (int i = 0; i < count; ++i) {
    const int vertex = random.below(surface.vertex_count());
    const bool is_stiff = (surface.vertex(vertex) - Vec3(0.02, 0.025, 0.0)).norm() < 0.006;
    palpations.push_back({.where = surface.at_vertex(vertex),
                          .reading = (is_stiff ? high : 1.0) + noise * random.normal()});
  }
  const Prior prior(surface, Metric::Chart, Kernel{}, Constant{.sd = 1.0});
  return Belief(prior, {.noise_sd = noise}).condition_on(palpations);
}

TEST(EdgeData, TakesNoiseOfAnotherSizeAfterReadingsWereMergedAsBefore) {
  const Surface surface = tissue();
  const Belief belief = felt(surface, 900, 3.0, 0.1);
  const Layout layout(belief.prior());
  Field field(surface.vertex_count());
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex)
    field[vertex] = 0.006 - (surface.vertex(vertex) - Vec3(0.02, 0.025, 0.0)).norm();
  EdgeData data = gathered_for_edge(belief);
  Eigen::VectorXd depths;
  ASSERT_TRUE(measure_depths(layout, field, 0.0, depths, data));
  const EdgeData after = with_noise(2.5, with_plateaus_merged(layout, data));
  data.variance *= 2.5;
  const EdgeData before = with_plateaus_merged(layout, data);
  ASSERT_LT(before.reading.size(), data.reading.size());
  EXPECT_NEAR(after.log_scatter, before.log_scatter, 1e-9 * std::abs(before.log_scatter));
  EXPECT_LT((after.variance - before.variance).norm(), 1e-12 * before.variance.norm());
}

/// Of one plateau the evidence is, but for constants and Schwarz's price, the likelihood at its
/// most probable mean and noise.
TEST(EdgeData, ReadingsWithoutAnEdgeAreAsProbableAsNormalOnes) {
  const Surface surface = tissue();
  const Belief belief = felt(surface, 60, 1.0, 0.3);
  const EdgeData data = gathered_for_edge(belief);
  const auto count = static_cast<double>(data.reading.size());
  double best = -1e300;
  for (double mean = 0.8; mean < 1.2; mean += 1e-3) {
    for (double scale = 0.3; scale < 3.0; scale += 1e-2) {
      double sum = 0.0;
      for (Eigen::Index i = 0; i < data.reading.size(); ++i)
        sum -= 0.5 * (std::pow(data.reading[i] - mean, 2) / (scale * data.variance[i]) +
                      std::log(scale * data.variance[i]));
      best = std::max(best, sum);
    }
  }
  EXPECT_NEAR(log_evidence_without_edge(belief), best - std::log(count), 2e-3);
}

}  // namespace
}  // namespace palpation
