#include "belief/reduced.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "belief/rows.h"
#include "belief/vertex_tiles.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

constexpr int kTilesAtOnce = 64;
constexpr int kFewSites = 64;        // are never worth reducing
constexpr int kMostFeatures = 3000;  // nor are more features than these

}  // namespace

/// Sites as the weight space takes them.
struct Belief::Regressors {
  Eigen::VectorXd noise;
  WeightSpace::Right right;
  double scatter = 0.0;
  bool all_plain = true;
};

Belief::Regressors Belief::regressors(std::span<const Site> sites) const {
  const auto count = static_cast<Eigen::Index>(sites.size());
  const double signal_variance = signal_sd() * signal_sd();
  Regressors result{Eigen::VectorXd(count), WeightSpace::Right::Zero(count, 5)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const Site& site = sites[i];
    const MergedReading merged = merge(site, noise_variance());
    const bool keeps_pace = site.known.empty() && options_.noise_is_relative;
    result.noise[i] =
        keeps_pace ? options_.noise_sd * options_.noise_sd / static_cast<double>(site.plain.size())
                   : merged.variance / signal_variance;
    result.all_plain = result.all_plain && keeps_pace;
    result.right(i, 0) = 1.0;
    result.right(i, 1) = merged.mean - origin_;
    if (prior_.has_slope()) result.right.row(i).tail<3>() = prior_.tilt(site.place.coordinates);
    result.scatter += scatter_log_likelihood(site, noise_variance());
  }
  return result;
}

/// Takes the last readings in, in weight space. False where the exact belief is to take them.
bool Belief::reduce(std::size_t more) {
  if (options_.reduced_rank_tolerance == 0.0) return false;
  restate_spread();
  if (reduced_) {
    const bool same_noise = signal_sd() == reduced_->signal_sd || reduced_->noise_keeps_pace;
    if (same_noise && append_to_reduced(gather_sites(prior_, std::span(palpations_).last(more))))
      return true;
  } else if (palpations_.size() < static_cast<std::size_t>(2 * reduction_tried_at_) ||
             palpations_.size() < kFewSites) {
    return false;
  }
  return reduce_all();
}

/// From all readings.
bool Belief::reduce_all() {
  const std::vector<Site> sites = gather_sites(prior_, palpations_);
  const int most = std::min(static_cast<int>(sites.size()), kMostFeatures);
  std::shared_ptr<const Features> features = reduced_ ? reduced_->features : nullptr;
  reduced_.reset();
  if (row_count() == 0) state_origin(sites);
  const Regressors readings = regressors(sites);
  if (sites.size() < kFewSites ||
      readings.noise.minCoeff() < kLeastNoiseForReducedRank * options_.reduced_rank_tolerance)
    return false;
  reduction_tried_at_ = static_cast<int>(sites.size());
  features = Features::of(prior_, sites, options_.reduced_rank_tolerance, most, features);
  if (!features) return false;
  prior_.surface().note_computed("features");

  rows_.clear();
  sites_.clear();
  repeat_count_ = 0;
  readings_.clear();
  diagonal_.clear();
  auto reduced = std::make_shared<Reduced>(
      Reduced{features, WeightSpace(features->at(prior_, sites), readings.noise, readings.right),
              static_cast<int>(sites.size()), signal_sd(), readings.all_plain,
              readings.noise.cwiseInverse().sum(), readings.scatter});
  reduced_ = reduced;
  see_all();
  restate_reduced();
  return true;
}

/// False where these readings need features that there are none of, or are too sharp.
bool Belief::append_to_reduced(const std::vector<Site>& sites) {
  const Features& features = *reduced_->features;
  const Regressors readings = regressors(sites);
  if (!sites.empty()) {
    if (readings.noise.minCoeff() < kLeastNoiseForReducedRank * options_.reduced_rank_tolerance)
      return false;
    const Eigen::MatrixXd seen = features.at(prior_, sites);
    if (1.0 - seen.colwise().squaredNorm().minCoeff() > options_.reduced_rank_tolerance)
      return false;
    auto next = std::make_shared<Reduced>(*reduced_);
    const WeightSpace::Rows rows = next->weights.append(seen, readings.noise, readings.right);
    next->site_count += static_cast<int>(sites.size());
    next->noise_keeps_pace = next->noise_keeps_pace && readings.all_plain;
    next->precision += readings.noise.cwiseInverse().sum();
    next->scatter += readings.scatter;
    reduced_ = next;
    see(rows);
  }
  restate_reduced();
  return true;
}

void Belief::restate_reduced() {
  const WeightSpace::Right& whitened = reduced_->weights.whitened();
  ones_ = whitened.col(0);
  whitened_ = whitened.col(1);
  if (prior_.has_slope()) tilts_ = whitened.rightCols<3>();
  restate_constant();
  restate_slope();
}

/// The sums over the vertices, from the features alone: |f|^2 - f' A^-1 f and f.w.
void Belief::see_all() {
  const Features& features = *reduced_->features;
  const int rank = features.rank(), tile_count = prior_.tiles().count(),
            weight_count = sum_rows() - 2;
  const WeightSpace::Rows factor = reduced_->weights.factor();
  const Eigen::Matrix<double, 5, Eigen::Dynamic, Eigen::RowMajor> minus_weights =
      -reduced_->weights.weights().transpose();
  const PackedFactor packed(factor.data(), rank, rank, rank),
      weights(minus_weights.data(), rank, weight_count, rank);
  const long per_tile = static_cast<long>(rank) * kLanes;
  auto sums = std::make_shared<Sums>(tile_count, sum_rows());
  for_ranges(tile_count, kTilesAtOnce, [&](int first, int last) {
    const AlignedDoubles solved =
        aligned_doubles(static_cast<std::size_t>(kTilesTogether * per_tile));
    for (int begin = first; begin < last; begin += kTilesTogether) {
      const int count = std::min(kTilesTogether, last - begin);
      const double* tiles = features.tile(begin);
      double* sum = sums->tile(begin);
      const long per_sum = static_cast<long>(sums->width) * kLanes;
      std::fill_n(sum, count * per_sum, 0.0);
      subtract_product(weights, features.rows(), begin, count, sum + Sums::kOnes * kLanes, per_sum);
      std::copy_n(tiles, count * per_tile, solved.get());
      solve_triangle(packed, solved.get(), count, per_tile);
      for (int tile = 0; tile < count; ++tile) {
        double* explained = sum + tile * per_sum + Sums::kExplained * kLanes;
        for (long at = tile * per_tile; at < (tile + 1) * per_tile; ++at)
          explained[at % kLanes] += tiles[at] * tiles[at] - solved[at] * solved[at];
      }
    }
  });
  sums_ = std::move(sums);
}

/// What the last readings add to the sums: rows t f as if of V.
void Belief::see(
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& rows) {
  const Features& features = *reduced_->features;
  const int rank = features.rank(), tile_count = prior_.tiles().count(),
            count = static_cast<int>(rows.rows());
  const Eigen::MatrixXd whitened = reduced_->weights.whitened().bottomRows(count);
  const WeightSpace::Rows minus_rows = -rows;
  const PackedFactor packed(minus_rows.data(), rank, count, rank);
  const long per_tile = static_cast<long>(count) * kLanes;
  auto sums = std::make_shared<Sums>(tile_count, sum_rows());
  for_ranges(tile_count, kTilesAtOnce, [&](int first, int last) {
    const AlignedDoubles v = aligned_doubles(static_cast<std::size_t>(kTilesTogether * per_tile));
    for (int begin = first; begin < last; begin += kTilesTogether) {
      const int tiles = std::min(kTilesTogether, last - begin);
      std::copy_n(sums_->tile(begin), static_cast<long>(tiles) * sums->width * kLanes,
                  sums->tile(begin));
      std::fill_n(v.get(), tiles * per_tile, 0.0);
      subtract_product(packed, features.rows(), begin, tiles, v.get(), per_tile);
      for (int tile = 0; tile < tiles; ++tile)
        add_sums(v.get() + tile * per_tile, count, whitened.data(), count, sum_rows() - 2,
                 sums->tile(begin + tile));
    }
  });
  sums_ = std::move(sums);
}

/// With E the residual's covariance, at most e everywhere, a the weights of the reduced belief at a
/// place and s^2 its variance: the exact variance is the least of |(1, -a)|^2 in the covariance
/// with E, plus a' D a, so s^2 + e (1 + |a|_1)^2 bounds it; and the means differ by (e(x) - E a)'
/// alpha, alpha = D^-1 (y - mean). a' D a <= s^2 and alpha' D alpha <= y' S^-1 y bound both sums of
/// magnitudes.
std::optional<ReducedRank> Belief::reduced_rank() const {
  if (!reduced_) return std::nullopt;
  const double signal = signal_sd();
  const double residual = std::max(reduced_->features->residual(), options_.reduced_rank_tolerance);
  const double root = std::sqrt(reduced_->precision);
  const double unsure = 1.0 + root * std::sqrt(at_vertices().variance.maxCoeff()) / signal;
  const double square = (whitened_ - (constant_ - origin_) * ones_).squaredNorm();
  return ReducedRank{reduced_->features->rank(), residual * unsure * root * std::sqrt(square),
                     residual * unsure * unsure * signal * signal};
}

}  // namespace palpation
