// What a belief answers: mean and variance at the vertices, from the sums over all rows, and
// anywhere else.
#include <algorithm>

#include "belief/belief_state.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

constexpr int kTilesAtOnce = 512;

void add_slope(const Regression& regression, const Vec3& residual, double signal_variance,
               double& mean, double& variance) {
  variance += signal_variance * residual.dot(regression.tilt_weights(residual));
  mean += regression.tilt().dot(residual);
}

/// Without the slope, whatever the prior has.
void look_at_tile(const BeliefState& state, int tile, Marginals& marginals) {
  const VertexTiles& tiles = state.field.prior.tiles();
  const Regression& regression = state.regression;
  const double* sums = state.engine().sums()->tile(tile);
  const int* vertices = tiles.vertices(tile);
  const double signal_variance = state.field.signal_variance();
  const double constant_variance = regression.times_constant_variance(1.0);
  double mean[kLanes], variance[kLanes];
  state.engine().unexplained(tiles, tile, variance);
  for (int lane = 0; lane < kLanes; ++lane) {
    const double ones = sums[VertexSums::kOnes * kLanes + lane];
    mean[lane] = regression.mean(ones, sums[VertexSums::kReadings * kLanes + lane]);
    variance[lane] =
        signal_variance * (variance[lane] + (1.0 - ones) * (1.0 - ones) * constant_variance);
  }
  for (int lane = 0; lane < tiles.lanes(tile); ++lane) {
    marginals.mean[vertices[lane]] = mean[lane];
    marginals.variance[vertices[lane]] = variance[lane];
  }
}

Marginals at_vertices_of(const BeliefState& state, Part part) {
  const VertexTiles& tiles = state.field.prior.tiles();
  const double signal_variance = state.field.signal_variance();
  const int count = tiles.vertex_count();
  Marginals result{Eigen::VectorXd(count), Eigen::VectorXd(count)};
  if (!state.engine().sums()) {
    result.mean.setConstant(state.regression.constant());
    result.variance.setConstant(signal_variance *
                                (1.0 + state.regression.times_constant_variance(1.0)));
  }
  for_ranges(state.engine().sums() ? tiles.count() : 0, kTilesAtOnce, [&](int first, int last) {
    for (int tile = first; tile < last; ++tile) look_at_tile(state, tile, result);
  });
  for (int vertex = 0; vertex < count && state.field.prior.has_slope(); ++vertex) {
    add_slope(state.regression, state.tilt_residual(vertex, part), signal_variance,
              result.mean[vertex], result.variance[vertex]);
  }
  return result;
}

}  // namespace

Marginals Belief::at_vertices(Part part) const { return at_vertices_of(*state_, part); }

Marginals Belief::at(std::span<const SurfacePoint> points, Part part) const {
  const Prior& prior = state_->field.prior;
  const Regression& regression = state_->regression;
  const double signal_variance = state_->field.signal_variance();
  const auto count = std::ssize(points);
  Marginals result{Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for_ranges(static_cast<int>(count), 16, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const Place place = prior.place(points[i]);
      const Seen seen = state_->engine().look_at(prior, place);
      const double residual = 1.0 - seen.ones;
      result.mean[i] = regression.mean(seen.ones, seen.readings);
      result.variance[i] =
          signal_variance * (std::clamp(seen.unexplained, 0.0, 1.0) +
                             regression.times_constant_variance(residual * residual));
      if (!prior.has_slope()) continue;
      add_slope(regression,
                regression.tilt_residual(prior.tilt(place.coordinates), seen.tilts, residual, part),
                signal_variance, result.mean[i], result.variance[i]);
    }
  });
  return result;
}

Marginals marginals_once(const Prior& prior, const BeliefOptions& options,
                         std::span<const Palpation> palpations, Part part) {
  const Belief belief(prior, options);
  if (options.reduced_rank_tolerance > 0.0)
    return belief.condition_on(palpations).at_vertices(part);
  BeliefState state = belief.state();
  state.exact =
      state.exact.after(state.field, palpations, palpations.size(), ExactEngine::Keep::Sums);
  state.regression = Regression(state.field, state.exact.whitened());
  return at_vertices_of(state, part);
}

}  // namespace palpation
