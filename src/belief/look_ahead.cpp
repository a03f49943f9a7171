#include "belief/look_ahead.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "belief/belief_state.h"
#include "belief/correlations.h"
#include "palpation/base/error.h"

namespace palpation {

struct LookAhead::Touch {
  int vertex;
  TileCorrelations correlations;
  double constant_share;             // of c, for a residual of one at the other vertex
  Vec3 tilt_weights = Vec3::Zero();  // of the slope's residual there
  std::vector<double> earlier{};     // e_j at the touch, j before it
  double scale;                      // 1 / sqrt(variance + noise)
};

LookAhead::LookAhead(const Belief& belief, const Field& variance)
    : state_(belief.state()),
      tiles_(belief.prior().tiles()),
      signal_variance_(belief.signal_sd() * belief.signal_sd()) {
  require(variance.size() == tiles_.vertex_count(), "LookAhead",
          std::to_string(variance.size()) + " variances", "must be one for each vertex");
  variance_.resize(static_cast<std::size_t>(tiles_.count()) * kLanes);
  for (std::size_t place = 0; place < variance_.size(); ++place)
    variance_[place] = variance[tiles_.vertices(0)[place]];
  known_.resize(tiles_.count());
  e_.resize(tiles_.count());
}

LookAhead::~LookAhead() = default;

int LookAhead::touch_count() const { return static_cast<int>(touches_.size()); }

bool LookAhead::is_current(int tile) const { return known_[tile] == touch_count(); }

int LookAhead::tile_count() const { return tiles_.count(); }

std::span<const int> LookAhead::vertices(int tile) const {
  return {tiles_.vertices(tile), static_cast<std::size_t>(tiles_.lanes(tile))};
}

int LookAhead::tile_of(int vertex) const { return tiles_.place(vertex) / kLanes; }

const double* LookAhead::variances(int tile) const {
  return variance_.data() + static_cast<long>(tile) * kLanes;
}

/// c between the tile's vertices and `count` touches from `first` on, one a row.
void LookAhead::add_covariances(int tile, int first, int count, double* rows) const {
  const std::vector<TileRows> strips = state_.engine().rows();
  long depth = 0;
  for (const TileRows& strip : strips) {
    depth += strip.depth;
    // Tiles are looked at here and there, so nothing of them is near yet: ask for all of it at
    // once.
    for (int i = 0; i < strip.depth; ++i) __builtin_prefetch(strip.address(tile, i));
  }
  for (int k = 0; k < count; ++k) touches_[first + k].correlations(tile, 1, rows + k * kLanes);
  for (int k = 0; k < count && depth > 0; k += panel_rows()) {
    const Panel panel{columns_.data() + (first + k) * depth, depth,
                      std::min(panel_rows(), count - k), nullptr};
    subtract_strips(panel, strips.data(), static_cast<int>(strips.size()), tile, rows + k * kLanes);
  }
  const std::span around = vertices(tile);
  for (int k = 0; k < count; ++k) {
    const Touch& touch = touches_[first + k];
    for (std::size_t lane = 0; lane < around.size(); ++lane) {
      double& value = rows[k * kLanes + static_cast<int>(lane)];
      value = state_.engine().held(value, touch.vertex, around[lane]);
      if (touch.constant_share != 0.0)
        value += touch.constant_share * state_.residual_ones(around[lane]);
      if (state_.field.prior.has_slope())
        value += state_.tilt_residual(around[lane]).dot(touch.tilt_weights);
      value *= signal_variance_;
    }
  }
}

void LookAhead::bring_up_to_date(int tile) {
  const int first = known_[tile], count = touch_count() - first;
  if (count == 0) return;
  std::vector<double>& e = e_[tile];
  e.resize(static_cast<std::size_t>(touch_count()) * kLanes);
  add_covariances(tile, first, count, e.data() + first * kLanes);
  double* variance = variance_.data() + static_cast<long>(tile) * kLanes;
  for (int k = first; k < touch_count(); ++k) {
    double* row = e.data() + k * kLanes;
    for (int j = 0; j < k; ++j) {
      for (int lane = 0; lane < kLanes; ++lane)
        row[lane] -= e[j * kLanes + lane] * touches_[k].earlier[j];
    }
    for (int lane = 0; lane < kLanes; ++lane) {
      row[lane] *= touches_[k].scale;
      variance[lane] = std::max(0.0, variance[lane] - row[lane] * row[lane]);
    }
  }
  known_[tile] = touch_count();
}

void LookAhead::touch(int vertex, double noise_variance) {
  require(vertex >= 0 && vertex < state_.field.prior.surface().vertex_count(), "LookAhead",
          "vertex " + std::to_string(vertex), "is not on the surface");
  const int place = tiles_.place(vertex), tile = place / kLanes, lane = place % kLanes;
  bring_up_to_date(tile);
  const double total = variance_[place] + noise_variance;
  const Prior& prior = state_.field.prior;
  const Regression& regression = state_.regression;
  Touch next{.vertex = vertex,
             .correlations = TileCorrelations(prior, vertex),
             .constant_share = regression.times_constant_variance(state_.residual_ones(vertex)),
             .scale = total > 0.0 ? 1.0 / std::sqrt(total) : 0.0};
  if (prior.has_slope()) next.tilt_weights = regression.tilt_weights(state_.tilt_residual(vertex));
  for (int k = 0; k < touch_count(); ++k) next.earlier.push_back(e_[tile][k * kLanes + lane]);
  const std::vector<double> column = state_.engine().column(tiles_, vertex);
  columns_.insert(columns_.end(), column.begin(), column.end());
  touches_.push_back(std::move(next));
}

}  // namespace palpation
