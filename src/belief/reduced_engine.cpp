#include "belief/reduced_engine.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpation/base/parallel.h"

namespace palpation {
namespace {

constexpr int kTilesAtOnce = 64;
constexpr int kMostFeatures = 3000;  // more are never worth it

}  // namespace

/// Sites as the weight space takes them.
struct ReducedEngine::Regressors {
  Eigen::VectorXd noise;
  WeightSpace::Right right;
  double scatter = 0.0;
  bool all_plain = true;
};

ReducedEngine::Regressors ReducedEngine::regressors(const ScaledPrior& field,
                                                    std::span<const Site> sites, double origin) {
  const BeliefOptions& options = field.options;
  const double noise_variance = field.noise_variance();
  Regressors result{Eigen::VectorXd(std::ssize(sites)),
                    WeightSpace::Right::Zero(std::ssize(sites), 5)};
  for (Eigen::Index i = 0; i < std::ssize(sites); ++i) {
    const Site& site = sites[i];
    const MergedReading merged = merge(site, noise_variance);
    const bool keeps_pace = site.known.empty() && options.noise_is_relative;
    result.noise[i] =
        keeps_pace ? options.noise_sd * options.noise_sd / static_cast<double>(site.plain.size())
                   : merged.variance / field.signal_variance();
    result.all_plain = result.all_plain && keeps_pace;
    result.right(i, 0) = 1.0;
    result.right(i, 1) = merged.mean - origin;
    if (field.prior.has_slope())
      result.right.row(i).tail<3>() = field.prior.tilt(site.place.coordinates);
    result.scatter += scatter_log_likelihood(site, noise_variance);
  }
  return result;
}

ReducedEngine::ReducedEngine(const ScaledPrior& field, std::span<const Site> sites,
                             std::shared_ptr<const Features> features, const Regressors& readings,
                             double origin)
    : features_(std::move(features)),
      weights_(features_->at(field.prior, sites), readings.noise, readings.right),
      site_count_(static_cast<int>(sites.size())),
      signal_sd_(field.signal_sd()),
      noise_keeps_pace_(readings.all_plain),
      precision_(readings.noise.cwiseInverse().sum()),
      scatter_(readings.scatter) {
  whitened_.origin = origin;
  see_all(field.prior);
  restate_whitened(field.prior.has_slope());
}

std::shared_ptr<const ReducedEngine> ReducedEngine::of(
    const ScaledPrior& field, std::span<const Site> sites, double origin,
    const std::shared_ptr<const Features>& known) {
  const double tolerance = field.options.reduced_rank_tolerance;
  const int most = std::min(static_cast<int>(sites.size()), kMostFeatures);
  auto features = Features::of(field.prior, sites, tolerance, most, known);
  if (!features) return nullptr;
  field.prior.surface().note_computed("features");
  const Regressors readings = regressors(field, sites, origin);
  return std::shared_ptr<const ReducedEngine>(
      new ReducedEngine(field, sites, std::move(features), readings, origin));
}

bool ReducedEngine::are_noisy(const ScaledPrior& field, std::span<const Site> sites) {
  return regressors(field, sites, 0.0).noise.minCoeff() >=
         kLeastNoiseForReducedRank * field.options.reduced_rank_tolerance;
}

std::shared_ptr<const ReducedEngine> ReducedEngine::with(const ScaledPrior& field,
                                                         std::span<const Site> sites) const {
  if (field.signal_sd() != signal_sd_ && !noise_keeps_pace_) return nullptr;
  auto next = std::make_shared<ReducedEngine>(*this);
  if (sites.empty()) return next;
  const Regressors readings = regressors(field, sites, whitened_.origin);
  const double tolerance = field.options.reduced_rank_tolerance;
  if (readings.noise.minCoeff() < kLeastNoiseForReducedRank * tolerance) return nullptr;
  const Eigen::MatrixXd seen = features_->at(field.prior, sites);
  if (1.0 - seen.colwise().squaredNorm().minCoeff() > tolerance) return nullptr;
  const WeightSpace::Rows rows = next->weights_.append(seen, readings.noise, readings.right);
  next->site_count_ += static_cast<int>(sites.size());
  next->noise_keeps_pace_ = noise_keeps_pace_ && readings.all_plain;
  next->precision_ += readings.noise.cwiseInverse().sum();
  next->scatter_ += readings.scatter;
  next->see(field.prior, rows);
  next->restate_whitened(field.prior.has_slope());
  return next;
}

void ReducedEngine::restate_whitened(bool has_slope) {
  whitened_.ones = weights_.whitened().col(0);
  whitened_.readings = weights_.whitened().col(1);
  if (has_slope) whitened_.tilts = weights_.whitened().rightCols<3>();
}

Seen ReducedEngine::look_at(const Prior& prior, const Place& place) const {
  const Eigen::VectorXd f = features_->at(prior, place);
  const Eigen::Matrix<double, 5, 1> sums = weights_.weights().transpose() * f;
  return {1.0 - f.dot(weights_.explained(f)), sums[0], sums[1], sums.tail<3>()};
}

void ReducedEngine::unexplained(const VertexTiles&, int tile, double* of_lanes) const {
  const double* explained = sums_->tile(tile) + VertexSums::kExplained * kLanes;
  const double floor = 1.0 / (1.0 + precision_);
  for (int lane = 0; lane < kLanes; ++lane)
    of_lanes[lane] = std::min(std::max(1.0 - explained[lane], floor), 1.0);
}

std::vector<double> ReducedEngine::column(const VertexTiles&, int vertex) const {
  const Eigen::VectorXd known = weights_.explained(features_->at_vertex(vertex));
  return {known.begin(), known.end()};
}

/// The sums over the vertices, from the features alone: |f|^2 - f' A^-1 f and f.w.
void ReducedEngine::see_all(const Prior& prior) {
  const Features& features = *features_;
  const int rank = features.rank(), tile_count = prior.tiles().count();
  auto sums = std::make_shared<VertexSums>(tile_count, prior.has_slope());
  const int weight_count = sums->width - 2;
  const WeightSpace::Rows factor = weights_.factor();
  const Eigen::Matrix<double, 5, Eigen::Dynamic, Eigen::RowMajor> minus_weights =
      -weights_.weights().transpose();
  const PackedFactor packed(factor.data(), rank, rank, rank),
      weights(minus_weights.data(), rank, weight_count, rank);
  const long per_tile = static_cast<long>(rank) * kLanes;
  for_ranges(tile_count, kTilesAtOnce, [&](int first, int last) {
    const AlignedDoubles solved =
        aligned_doubles(static_cast<std::size_t>(kTilesTogether * per_tile));
    for (int begin = first; begin < last; begin += kTilesTogether) {
      const int count = std::min(kTilesTogether, last - begin);
      const double* tiles = features.tile(begin);
      double* sum = sums->tile(begin);
      const long per_sum = static_cast<long>(sums->width) * kLanes;
      std::fill_n(sum, count * per_sum, 0.0);
      subtract_product(weights, features.rows(), begin, count, sum + VertexSums::kOnes * kLanes,
                       per_sum);
      std::copy_n(tiles, count * per_tile, solved.get());
      solve_triangle(packed, solved.get(), count, per_tile);
      for (int tile = 0; tile < count; ++tile) {
        double* explained = sum + tile * per_sum + VertexSums::kExplained * kLanes;
        for (long at = tile * per_tile; at < (tile + 1) * per_tile; ++at)
          explained[at % kLanes] += tiles[at] * tiles[at] - solved[at] * solved[at];
      }
    }
  });
  sums_ = std::move(sums);
}

/// What the last readings add to the sums: rows t f as if of V.
void ReducedEngine::see(const Prior& prior, const WeightSpace::Rows& rows) {
  const Features& features = *features_;
  const int rank = features.rank(), tile_count = prior.tiles().count(),
            count = static_cast<int>(rows.rows());
  const Eigen::MatrixXd whitened = weights_.whitened().bottomRows(count);
  const WeightSpace::Rows minus_rows = -rows;
  const PackedFactor packed(minus_rows.data(), rank, count, rank);
  const long per_tile = static_cast<long>(count) * kLanes;
  auto sums = std::make_shared<VertexSums>(tile_count, prior.has_slope());
  for_ranges(tile_count, kTilesAtOnce, [&](int first, int last) {
    const AlignedDoubles v = aligned_doubles(static_cast<std::size_t>(kTilesTogether * per_tile));
    for (int begin = first; begin < last; begin += kTilesTogether) {
      const int tiles = std::min(kTilesTogether, last - begin);
      std::copy_n(sums_->tile(begin), static_cast<long>(tiles) * sums->width * kLanes,
                  sums->tile(begin));
      std::fill_n(v.get(), tiles * per_tile, 0.0);
      subtract_product(packed, features.rows(), begin, tiles, v.get(), per_tile);
      for (int tile = 0; tile < tiles; ++tile)
        add_sums(v.get() + tile * per_tile, count, whitened.data(), count, sums->width - 2,
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
ReducedRank ReducedEngine::loss(const ScaledPrior& field, const Regression& regression,
                                double greatest_variance) const {
  const double signal = field.signal_sd();
  const double residual = std::max(features_->residual(), field.options.reduced_rank_tolerance);
  const double root = std::sqrt(precision_);
  const double unsure = 1.0 + root * std::sqrt(greatest_variance) / signal;
  const double square =
      (whitened_.readings - (regression.constant() - whitened_.origin) * whitened_.ones)
          .squaredNorm();
  return {features_->rank(), residual * unsure * root * std::sqrt(square),
          residual * unsure * unsure * signal * signal};
}

}  // namespace palpation
