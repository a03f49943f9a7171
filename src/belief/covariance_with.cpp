#include <algorithm>
#include <cmath>
#include <string>

#include "belief/correlations.h"
#include "belief/reduced.h"
#include "belief/rows.h"
#include "belief/vertex_tiles.h"
#include "palpation/base/error.h"

namespace palpation {

std::vector<TileRows> Belief::rows_of_v() const {
  if (reduced_) return {reduced_->features->rows()};
  std::vector<TileRows> all;
  for (const auto& rows : rows_) all.push_back(rows->strip());
  return all;
}

/// What of rows_of_v() is to be taken off a correlation with this vertex.
std::vector<double> Belief::column_of_v(int vertex) const {
  if (reduced_) {
    const Eigen::VectorXd known =
        reduced_->weights.explained(reduced_->features->at_vertex(vertex));
    return {known.begin(), known.end()};
  }
  std::vector<double> column;
  column.reserve(static_cast<std::size_t>(site_count()));
  const int place = prior_.tiles().place(vertex);
  for (const auto& rows : rows_) {
    for (int row = 0; row < rows->count; ++row) column.push_back(rows->value(row, place));
  }
  return column;
}

/// A covariance between two vertices, no more than what their variances allow where these are
/// sharp.
double Belief::held(double covariance, int a, int b) const {
  if (sharp_.size() == 0) return covariance;
  const double most = std::sqrt(sharp_[a] * sharp_[b]);
  return a == b ? most : std::clamp(covariance, -most, most);
}

double Belief::residual_ones(int vertex) const {
  return sums_ ? 1.0 - sums_->at(prior_.tiles().place(vertex), Sums::kOnes) : 1.0;
}

CovarianceWith::CovarianceWith(const Belief& belief, int vertex)
    : belief_(belief), vertex_(vertex) {
  require(vertex >= 0 && vertex < belief.prior_.surface().vertex_count(), "CovarianceWith",
          "vertex " + std::to_string(vertex), "is not on the surface");
  correlations_ = std::make_shared<const TileCorrelations>(belief.prior_, vertex);
  column_ = belief.column_of_v(vertex);
  residual_ones_ = belief.residual_ones(vertex);
  if (belief.prior_.has_slope())
    tilt_weights_ = belief.tilt_covariance_ * belief.tilt_residual_at(vertex, Part::Whole);
}

void CovarianceWith::operator()(int first, int count, double* out) const {
  const VertexTiles& tiles = belief_.prior_.tiles();
  const double signal_variance = belief_.signal_sd() * belief_.signal_sd();
  const double constant_share =
      belief_.constant_is_unsure() ? residual_ones_ / belief_.constant_precision_ : 0.0;
  const std::vector<TileRows> strips = belief_.rows_of_v();
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
      double value = belief_.held(covariance[lane], vertex_, vertex) +
                     constant_share * belief_.residual_ones(vertex);
      if (belief_.prior_.has_slope())
        value += belief_.tilt_residual_at(vertex, Part::Whole).dot(tilt_weights_);
      out[vertex - first] = signal_variance * value;
    }
  }
}

}  // namespace palpation
