// What a belief answers: mean and variance at the vertices, from the sums over all rows, and
// anywhere else.
#include <algorithm>
#include <cmath>

#include "belief/correlations.h"
#include "belief/reduced.h"
#include "belief/rows.h"
#include "belief/seen.h"
#include "belief/vertex_tiles.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

constexpr int kTilesAtOnce = 512;

}  // namespace

/// r of the header at x, for a slope of one standard deviation.
Vec3 Belief::tilt_residual(const Vec3& x, const Vec3& v_tilts, double residual_ones,
                           Part part) const {
  const Vec3 of_component = -v_tilts - residual_ones * constant_per_tilt_;
  return part == Part::Detrended ? of_component : Vec3(prior_.tilt(x) + of_component);
}

Eigen::VectorXd Belief::solve_lower(Eigen::VectorXd right_side) const {
  for (const auto& rows : rows_) {
    auto part = right_side.segment(rows->first, rows->count);
    part.noalias() -= rows->factor.leftCols(rows->first) * right_side.head(rows->first);
    rows->factor.rightCols(rows->count).triangularView<Eigen::Lower>().solveInPlace(part);
  }
  return right_side;
}

Marginals Belief::at_vertices(Part part) const {
  const VertexTiles& tiles = prior_.tiles();
  // Since K >= k k', the variance is at least s / (s + |k|^2).
  const double least_noise =
      diagonal_.empty() ? 1.0 : *std::min_element(diagonal_.begin(), diagonal_.end());
  const double reduced_floor = reduced_ ? 1.0 / (1.0 + reduced_->precision) : 0.0;
  const double signal_variance = signal_sd() * signal_sd();
  const double constant_variance = constant_is_unsure() ? 1.0 / constant_precision_ : 0.0;
  Marginals result{Eigen::VectorXd(tiles.vertex_count()), Eigen::VectorXd(tiles.vertex_count())};
  if (!sums_) {
    result.mean.setConstant(constant_);
    result.variance.setConstant(signal_variance * (1.0 + constant_variance));
  }
  for_ranges(sums_ ? tiles.count() : 0, kTilesAtOnce, [&](int first, int last) {
    for (int tile = first; tile < last; ++tile) {
      const double* sums = sums_->tile(tile);
      const int* vertices = tiles.vertices(tile);
      double mean[kLanes], variance[kLanes];
      for (int lane = 0; lane < kLanes; ++lane) {
        const double ones = sums[Sums::kOnes * kLanes + lane],
                     covered = sums[sums_->covered() * kLanes + lane];
        const double floor = reduced_            ? reduced_floor
                             : least_noise > 0.0 ? least_noise / (least_noise + covered)
                                                 : 0.0;
        const double left = sharp_.size() == 0 ? 1.0 - sums[Sums::kExplained * kLanes + lane]
                                               : sharp_[vertices[lane]];
        const double unexplained = std::min(std::max(left, floor), 1.0);
        mean[lane] =
            constant_ + (sums[Sums::kWhitened * kLanes + lane] - (constant_ - origin_) * ones);
        variance[lane] =
            signal_variance * (unexplained + (1.0 - ones) * (1.0 - ones) * constant_variance);
      }
      for (int lane = 0; lane < tiles.lanes(tile); ++lane) {
        result.mean[vertices[lane]] = mean[lane];
        result.variance[vertices[lane]] = variance[lane];
      }
    }
  });
  if (prior_.has_slope()) add_slope(part, result);
  return result;
}

void Belief::add_slope(Part part, Marginals& marginals) const {
  const double signal_variance = signal_sd() * signal_sd();
  for (int vertex = 0; vertex < marginals.mean.size(); ++vertex) {
    const Vec3 tilt = tilt_residual_at(vertex, part);
    marginals.variance[vertex] += signal_variance * tilt.dot(tilt_covariance_ * tilt);
    marginals.mean[vertex] += tilt_.dot(tilt);
  }
}

Vec3 Belief::tilt_residual_at(int vertex, Part part) const {
  if (!sums_) return tilt_residual(prior_.coordinates(vertex), Vec3::Zero(), 1.0, part);
  const int place = prior_.tiles().place(vertex);
  const Vec3 v_tilts(sums_->at(place, Sums::kTilts), sums_->at(place, Sums::kTilts + 1),
                     sums_->at(place, Sums::kTilts + 2));
  return tilt_residual(prior_.coordinates(vertex), v_tilts, 1.0 - sums_->at(place, Sums::kOnes),
                       part);
}

Marginals marginals_once(const Prior& prior, const BeliefOptions& options,
                         std::span<const Palpation> palpations, Part part) {
  Belief belief(prior, options);
  if (options.reduced_rank_tolerance > 0.0)
    return belief.condition_on(palpations).at_vertices(part);
  belief.palpations_.assign(palpations.begin(), palpations.end());
  belief.restate_sites(palpations.size());
  belief.restate_readings();
  // Where there is little noise the rows are looked at again.
  const bool is_sharp = std::ranges::any_of(
      belief.diagonal_, [](double noise) { return noise < Belief::kSmallNoise; });
  belief.append_rows(is_sharp ? Belief::Keep::Rows : Belief::Keep::Nothing);
  belief.sharpen();
  belief.restate_constant();
  belief.restate_slope();
  return belief.at_vertices(part);
}

Marginals Belief::at(std::span<const SurfacePoint> points, Part part) const {
  const int count = static_cast<int>(points.size());
  const double signal_variance = signal_sd() * signal_sd();
  Marginals result{Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for_ranges(count, 16, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const Place place = prior_.place(points[i]);
      const Seen seen = look_at(place);
      double variance = std::clamp(seen.unexplained, 0.0, 1.0);
      const double residual = 1.0 - seen.ones;
      if (constant_is_unsure()) variance += residual * residual / constant_precision_;
      result.variance[i] = signal_variance * variance;
      result.mean[i] = constant_ + (seen.whitened - (constant_ - origin_) * seen.ones);
      if (prior_.has_slope()) {
        const Vec3 tilt = tilt_residual(place.coordinates, seen.tilts, residual, part);
        result.variance[i] += signal_variance * tilt.dot(tilt_covariance_ * tilt);
        result.mean[i] += tilt_.dot(tilt);
      }
    }
  });
  return result;
}

}  // namespace palpation
