#include "belief/covariance_with.h"

#include <algorithm>
#include <string>

#include "belief/belief_state.h"
#include "belief/correlations.h"
#include "palpation/base/error.h"

namespace palpation {

CovarianceWith::CovarianceWith(const Belief& belief, int vertex)
    : state_(belief.state()), vertex_(vertex) {
  const Prior& prior = belief.prior();
  require(vertex >= 0 && vertex < prior.surface().vertex_count(), "CovarianceWith",
          "vertex " + std::to_string(vertex), "is not on the surface");
  correlations_ = std::make_shared<const TileCorrelations>(prior, vertex);
  column_ = state_.engine().column(prior.tiles(), vertex);
  residual_ones_ = state_.residual_ones(vertex);
  if (prior.has_slope())
    tilt_weights_ = state_.regression.tilt_weights(state_.tilt_residual(vertex));
}

void CovarianceWith::operator()(int first, int count, double* out) const {
  const Prior& prior = state_.field.prior;
  const VertexTiles& tiles = prior.tiles();
  const double signal_variance = state_.field.signal_variance();
  const double constant_share = state_.regression.times_constant_variance(residual_ones_);
  const std::vector<TileRows> strips = state_.engine().rows();
  for (int tile = 0; tile < tiles.count(); ++tile) {
    const std::span vertices(tiles.vertices(tile), static_cast<std::size_t>(tiles.lanes(tile)));
    const auto is_wanted = [&](int vertex) { return vertex >= first && vertex < first + count; };
    if (std::ranges::none_of(vertices, is_wanted)) continue;
    alignas(64) double covariance[kLanes];
    (*correlations_)(tile, 1, covariance);
    subtract_strips({.factor = column_.data(), .rows = 1}, strips.data(),
                    static_cast<int>(strips.size()), tile, covariance);
    for (std::size_t lane = 0; lane < vertices.size(); ++lane) {
      const int vertex = vertices[lane];
      if (!is_wanted(vertex)) continue;
      double value = state_.engine().held(covariance[lane], vertex_, vertex) +
                     constant_share * state_.residual_ones(vertex);
      if (prior.has_slope()) value += state_.tilt_residual(vertex).dot(tilt_weights_);
      out[vertex - first] = signal_variance * value;
    }
  }
}

}  // namespace palpation
