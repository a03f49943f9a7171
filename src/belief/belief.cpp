#include "palpation/belief/belief.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "belief/correlations.h"
#include "belief/reduced.h"
#include "belief/rows.h"
#include "belief/seen.h"
#include "palpation/base/error.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

constexpr int kTilesAtOnce = 64;
/// Rows of L alone then take 3 GB.
constexpr std::size_t kMostSites = 20000;

int tile_count(const Surface& surface) { return (surface.vertex_count() + kLanes - 1) / kLanes; }

double mean_of(const Eigen::VectorXd& values) {
  const double origin = values[0];
  return origin + (values.array() - origin).sum() / static_cast<double>(values.size());
}

Eigen::VectorXd used_readings(std::span<const Palpation> palpations) {
  std::vector<double> used;
  for (const Palpation& palpation : palpations) {
    if (palpation.set_aside.empty()) used.push_back(palpation.reading);
  }
  return Eigen::Map<const Eigen::VectorXd>(used.data(), static_cast<Eigen::Index>(used.size()));
}

}  // namespace

Belief::Belief(Prior prior, const BeliefOptions& options) : prior_(std::move(prior)), options_(options) {
  require(std::isfinite(options.noise_sd) && options.noise_sd >= 0.0, "Belief", "noise_sd = " + text_of(options.noise_sd),
          "must be finite and not negative");
  const double tolerance = options.reduced_rank_tolerance;
  require(tolerance == 0.0 || (tolerance >= 1e-13 && tolerance <= 1e-4), "Belief", "reduced_rank_tolerance = " + text_of(tolerance),
          "must be 0 or from 1e-13 to 1e-4");
  restate_readings();
  keep_rows(0);
  restate_constant();
  restate_slope();
}

double Belief::signal_sd() const { return prior_.kernel().signal_sd * spread_; }

double Belief::noise_variance() const {
  const double sd = options_.noise_is_relative ? options_.noise_sd * signal_sd() : options_.noise_sd;
  return sd * sd;
}

int Belief::site_count() const { return reduced_ ? reduced_->site_count : static_cast<int>(sites_.size()); }

int Belief::row_count() const { return rows_.empty() ? 0 : rows_.back()->first + rows_.back()->count; }

Belief Belief::condition_on(std::span<const Palpation> more) const {
  Belief next = *this;
  next.palpations_.insert(next.palpations_.end(), more.begin(), more.end());
  if (next.reduce(more.size())) return next;
  if (reduced_) next.keep_rows(0);
  next.restate_readings();
  int unchanged = 0;
  const int known = std::min(row_count(), next.site_count());
  while (unchanged < known && next.diagonal_[unchanged] == diagonal_[unchanged] && next.readings_[unchanged] == readings_[unchanged]) {
    ++unchanged;
  }
  if (unchanged < row_count()) next.keep_rows(unchanged);
  next.append_rows();
  next.sharpen();
  next.restate_constant();
  next.restate_slope();
  return next;
}

void Belief::restate_spread() {
  if (!options_.standardize) return;
  const Eigen::VectorXd readings = used_readings(palpations_);
  if (readings.size() == 0) return;
  centre_ = mean_of(readings);
  const double spread = std::sqrt((readings.array() - centre_).square().mean());
  require((spread > 1e-150 && spread < 1e150) || readings.minCoeff() == readings.maxCoeff(), "Belief",
          "readings between " + text_of(readings.minCoeff()) + " and " + text_of(readings.maxCoeff()),
          "cannot be standardized: the square of their spread must be a number");
  spread_ = spread > 0.0 ? spread : 1.0;
}

/// What readings are counted from where a constant takes up the difference.
void Belief::state_origin(std::span<const Site> sites) {
  if (!sites.empty()) origin_ = options_.standardize || prior_.constant().sd > 0.0 ? merge(sites.front(), noise_variance()).mean : 0.0;
}

/// Sites, their merged readings and the diagonal D.
void Belief::restate_readings() {
  sites_ = gather_sites(prior_, palpations_);
  require(sites_.size() <= kMostSites, "Belief", std::to_string(sites_.size()) + " places touched",
          "must be at most " + std::to_string(kMostSites) + " for an exact belief; one of reduced rank takes more");
  restate_spread();
  const double signal_variance = signal_sd() * signal_sd();
  const double plain_ratio = options_.noise_is_relative ? options_.noise_sd * options_.noise_sd : noise_variance() / signal_variance;
  readings_.clear();
  diagonal_.clear();
  for (const Site& site : sites_) {
    const MergedReading merged = merge(site, noise_variance());
    readings_.push_back(merged.mean);
    diagonal_.push_back(site.known.empty() ? plain_ratio / static_cast<double>(site.plain.size()) : merged.variance / signal_variance);
  }
  if (row_count() == 0) state_origin(sites_);
}

/// Forgets the rows from the first one that does not lie in a block before `count`, and restates the sums over the rest.
void Belief::keep_rows(int count) {
  while (!rows_.empty() && row_count() > count) rows_.pop_back();
  const int vertices = prior_.surface().vertex_count();
  if (prior_.has_slope()) {
    v_tilts_ = Tilts::Zero(vertices, 3);
    tilts_.conservativeResize(row_count(), 3);
  }
  explained_ = covered_ = v_ones_ = v_whitened_ = Field::Zero(vertices);
  ones_.conservativeResize(row_count());
  whitened_.conservativeResize(row_count());
  if (rows_.empty()) return;
  const TileCorrelations correlations(prior_, std::span(sites_).first(static_cast<std::size_t>(row_count())));
  std::vector<double> k(static_cast<std::size_t>(row_count()) * kLanes);
  for (int tile = 0; tile < tile_count(prior_.surface()); ++tile) {
    correlations(tile, k.data());
    for (int vertex = tile * kLanes; vertex < std::min((tile + 1) * kLanes, vertices); ++vertex) {
      for (const auto& rows : rows_) {
        for (int row = 0; row < rows->count; ++row) {
          const double v = rows->value(row, vertex);
          const double k_row = k[static_cast<std::size_t>((rows->first + row) * kLanes + vertex % kLanes)];
          explained_[vertex] += v * v;
          covered_[vertex] += k_row * k_row;
          v_ones_[vertex] += v * ones_[rows->first + row];
          v_whitened_[vertex] += v * whitened_[rows->first + row];
          if (prior_.has_slope()) v_tilts_.row(vertex) += v * tilts_.row(rows->first + row);
        }
      }
    }
  }
}

/// The rows of L for the sites from `first` on: row-append Cholesky, which is as accurate as factoring anew.
Eigen::MatrixXd Belief::factor_of_new_sites(int first) const {
  const int count = site_count() - first;
  Eigen::MatrixXd correlations = palpation::correlations(prior_, prior_.kernel(), sites_, first);
  for (int j = 0; j < count; ++j) correlations(first + j, j) += diagonal_[first + j];
  for (const auto& rows : rows_) {
    auto right_side = correlations.middleRows(rows->first, rows->count);
    right_side.noalias() -= rows->factor.leftCols(rows->first) * correlations.topRows(rows->first);
    rows->factor.rightCols(rows->count).triangularView<Eigen::Lower>().solveInPlace(right_side);
  }
  Eigen::MatrixXd factor(count, site_count());
  factor.leftCols(first) = correlations.topRows(first).transpose();
  for (int row = 0; row < count; ++row) {
    for (int column = 0; column <= row; ++column) {
      const double rest =
          correlations(first + column, row) - factor.row(row).head(first + column).dot(factor.row(column).head(first + column));
      if (column < row) {
        factor(row, first + column) = rest / factor(column, first + column);
      } else if (rest > 0.0 && std::isfinite(rest)) {
        factor(row, first + column) = std::sqrt(rest);
      } else {
        throw NumericalError("Belief: site " + std::to_string(first + row) + " leaves the pivot " + text_of(rest) +
                             ", so the covariance is not positive definite in double precision: sites all but coincide, and the noise (" +
                             text_of(diagonal_[first + row]) + " of the signal's variance) does not part them");
      }
    }
    factor.row(row).tail(count - row - 1).setZero();
  }
  return factor;
}

/// Rows of L and V for all sites that have none yet, and their share of the sums, in one pass over the vertices.
void Belief::append_rows() {
  const int first = row_count();
  const int count = site_count() - first;
  if (count == 0) return;
  auto fresh = std::make_shared<Rows>();
  fresh->first = first;
  fresh->count = count;
  fresh->factor = factor_of_new_sites(first);
  const auto& factor = fresh->factor;

  ones_.conservativeResize(site_count());
  whitened_.conservativeResize(site_count());
  for (int row = 0; row < count; ++row) {
    const auto before = factor.row(row).head(first + row);
    const double pivot = factor(row, first + row);
    ones_[first + row] = (1.0 - before.dot(ones_.head(first + row))) / pivot;
    whitened_[first + row] = (readings_[first + row] - origin_ - before.dot(whitened_.head(first + row))) / pivot;
  }

  if (prior_.has_slope()) {
    tilts_.conservativeResize(site_count(), 3);
    for (int row = 0; row < count; ++row) {
      const Vec3 tilt = prior_.tilt(sites_[first + row].place.coordinates);
      tilts_.row(first + row) =
          (tilt.transpose() - factor.row(row).head(first + row) * tilts_.topRows(first + row)) / factor(row, first + row);
    }
  }

  const Surface& surface = prior_.surface();
  fresh->v = std::make_unique_for_overwrite<double[]>(static_cast<std::size_t>(tile_count(surface)) * count * kLanes);
  const int stride = static_cast<int>(factor.cols());
  const TileCorrelations correlations(prior_, std::span(sites_).subspan(static_cast<std::size_t>(first)));
  for_ranges(tile_count(surface), kTilesAtOnce, [&](int first_tile, int last_tile) {
    for (int tile = first_tile; tile < last_tile; ++tile) {
      double* rows = fresh->tile(tile);
      correlations(tile, rows);
      for (int vertex = tile * kLanes; vertex < std::min((tile + 1) * kLanes, surface.vertex_count()); ++vertex) {
        for (int row = 0; row < count; ++row)
          covered_[vertex] += rows[row * kLanes + vertex % kLanes] * rows[row * kLanes + vertex % kLanes];
      }
      for (const auto& block : rows_) subtract_product(factor.data() + block->first, stride, block->tile(tile), block->count, rows, count);
      solve_triangle(factor.data() + first, stride, rows, count);
      for (int lane = 0; lane < kLanes && tile * kLanes + lane < surface.vertex_count(); ++lane) {
        const int vertex = tile * kLanes + lane;
        for (int row = 0; row < count; ++row) {
          const double v = rows[row * kLanes + lane];
          explained_[vertex] += v * v;
          v_ones_[vertex] += v * ones_[first + row];
          v_whitened_[vertex] += v * whitened_[first + row];
          if (prior_.has_slope()) v_tilts_.row(vertex) += v * tilts_.row(first + row);
        }
      }
    }
  });
  rows_.push_back(std::move(fresh));
}

/// Posterior of the constant: prior N(centre, sd^2) and L^-1 (y - c) white.
void Belief::restate_constant() {
  const double prior_sd = prior_.constant().sd * (options_.standardize ? spread_ : 1.0);
  if (prior_sd == 0.0) {
    constant_precision_ = std::numeric_limits<double>::infinity();
    constant_ = centre_;
    return;
  }
  const double ratio = signal_sd() / prior_sd;
  const double prior_precision = ratio * ratio;
  constant_precision_ = prior_precision + ones_.squaredNorm();
  constant_ =
      constant_precision_ > 0.0 ? origin_ + (prior_precision * (centre_ - origin_) + ones_.dot(whitened_)) / constant_precision_ : centre_;
}

bool Belief::constant_is_unsure() const { return std::isfinite(constant_precision_) && constant_precision_ > 0.0; }

/// Posterior of the slope once the constant is integrated out: B = signal^2 I + W'W - W'1 1'W / (the constant's precision), W = tilts_.
void Belief::restate_slope() {
  if (!prior_.has_slope()) return;
  const double slope_precision = prior_.kernel().signal_sd * prior_.kernel().signal_sd;  // of a prior of unit variance, over the signal's
  const Vec3 along_ones = tilts_.transpose() * ones_;
  constant_per_tilt_ = constant_is_unsure() ? Vec3(along_ones / constant_precision_) : Vec3(Vec3::Zero());
  Eigen::Matrix3d precision = tilts_.transpose() * tilts_ - along_ones * constant_per_tilt_.transpose();
  precision.diagonal().array() += slope_precision;
  tilt_covariance_ = precision.llt().solve(Eigen::Matrix3d::Identity());
  tilt_ = tilt_covariance_ * (tilts_.transpose() * (whitened_ - (constant_ - origin_) * ones_));
}

/// r of the header at x, for a slope of one standard deviation.
Vec3 Belief::tilt_residual(const Vec3& x, const Vec3& v_tilts, double residual_ones, Part part) const {
  const Vec3 of_component = -v_tilts - residual_ones * constant_per_tilt_;
  return part == Part::Detrended ? of_component : Vec3(prior_.tilt(x) + of_component);
}

Vec3 Belief::slope() const { return prior_.slope().sd.cwiseProduct(tilt_); }

std::vector<Palpation> Belief::detrended_palpations() const {
  std::vector<Palpation> detrended = palpations_;
  if (!prior_.has_slope()) return detrended;
  for (Palpation& palpation : detrended) palpation.reading -= tilt_.dot(prior_.tilt(prior_.coordinates(palpation.where)));
  return detrended;
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
  const int vertices = prior_.surface().vertex_count();
  // Since K >= k k', the variance is at least s / (s + |k|^2).
  const double least_noise = diagonal_.empty() ? 1.0 : *std::min_element(diagonal_.begin(), diagonal_.end());
  const double signal_variance = signal_sd() * signal_sd();
  Marginals result{Eigen::VectorXd(vertices), Eigen::VectorXd(vertices)};
  for (int vertex = 0; vertex < vertices; ++vertex) {
    double floor = site_count() == 0 ? 1.0 : least_noise > 0.0 ? least_noise / (least_noise + covered_[vertex]) : 0.0;
    if (reduced_) floor = 1.0 / (1.0 + reduced_->precision);
    double variance = std::clamp(sharp_.size() == 0 ? 1.0 - explained_[vertex] : sharp_[vertex], floor, 1.0);
    const double residual = 1.0 - v_ones_[vertex];
    if (constant_is_unsure()) variance += residual * residual / constant_precision_;
    result.variance[vertex] = signal_variance * variance;
    result.mean[vertex] = constant_ + (v_whitened_[vertex] - (constant_ - origin_) * v_ones_[vertex]);
    if (prior_.has_slope()) {
      const Vec3 tilt = tilt_residual(prior_.coordinates(vertex), v_tilts_.row(vertex), residual, part);
      result.variance[vertex] += signal_variance * tilt.dot(tilt_covariance_ * tilt);
      result.mean[vertex] += tilt_.dot(tilt);
    }
  }
  return result;
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

double Belief::log_marginal_likelihood() const {
  const double signal_variance = signal_sd() * signal_sd();
  const int n = site_count();
  if (n == 0) return 0.0;
  const double prior_sd = prior_.constant().sd * (options_.standardize ? spread_ : 1.0);
  double log_determinant = n * std::log(signal_variance);
  if (reduced_) log_determinant += reduced_->weights.log_determinant();
  for (const auto& rows : rows_) {
    for (int row = 0; row < rows->count; ++row) log_determinant += 2.0 * std::log(rows->factor(row, rows->first + row));
  }
  double free_readings = n;
  double square = 0.0;
  if (std::isinf(prior_sd)) {
    square = (whitened_ - (constant_ - origin_) * ones_).squaredNorm();
    log_determinant += std::log(constant_precision_ / signal_variance);
    free_readings -= 1.0;
  } else {
    const Eigen::VectorXd centred = whitened_ - (centre_ - origin_) * ones_;
    square = centred.squaredNorm();
    if (prior_sd > 0.0) {
      const double projection = centred.dot(ones_);
      square -= projection * projection / constant_precision_;
      log_determinant += std::log(constant_precision_ * prior_sd * prior_sd / signal_variance);
    }
  }
  if (prior_.has_slope()) {
    square -= tilt_.dot(tilt_covariance_.inverse() * tilt_);
    log_determinant -= std::log(tilt_covariance_.determinant()) + 3.0 * std::log(prior_.kernel().signal_sd * prior_.kernel().signal_sd);
  }
  double result = -0.5 * (square / signal_variance + log_determinant + free_readings * std::log(2.0 * std::numbers::pi));
  if (reduced_) result += reduced_->scatter;
  for (const Site& site : sites_) result += scatter_log_likelihood(site, noise_variance());
  return result;
}

CovarianceWith::CovarianceWith(const Belief& belief, int vertex) : belief_(belief), vertex_(vertex) {
  require(vertex >= 0 && vertex < belief.prior_.surface().vertex_count(), "CovarianceWith", "vertex " + std::to_string(vertex),
          "is not on the surface");
  correlations_ = std::make_shared<const TileCorrelations>(belief.prior_, vertex);
  if (belief.reduced_) {
    const Eigen::VectorXd known = belief.reduced_->weights.explained(belief.reduced_->features->at_vertex(vertex));
    column_.assign(known.begin(), known.end());
  }
  for (const auto& rows : belief.rows_) {
    for (int row = 0; row < rows->count; ++row) column_.push_back(rows->value(row, vertex));
  }
  residual_ones_ = 1.0 - belief.v_ones_[vertex];
  if (belief.prior_.has_slope()) {
    const Vec3 tilt = belief.tilt_residual(belief.prior_.coordinates(vertex), belief.v_tilts_.row(vertex), residual_ones_, Part::Whole);
    tilt_weights_ = belief.tilt_covariance_ * tilt;
  }
}

void CovarianceWith::operator()(int first, int count, double* out) const {
  const Prior& prior = belief_.prior_;
  const double signal_variance = belief_.signal_sd() * belief_.signal_sd();
  const double constant_share = belief_.constant_is_unsure() ? residual_ones_ / belief_.constant_precision_ : 0.0;
  for (int tile = first / kLanes; tile * kLanes < first + count; ++tile) {
    double covariance[kLanes] = {}, prior_correlations[kLanes];
    (*correlations_)(tile, prior_correlations);
    for (const auto& rows : belief_.rows_) {
      subtract_product(column_.data() + rows->first, 0, rows->tile(tile), rows->count, covariance, 1);
    }
    if (belief_.reduced_)
      subtract_product(column_.data(), 0, belief_.reduced_->features->tile(tile), static_cast<int>(column_.size()), covariance, 1);
    for (int lane = 0; lane < kLanes; ++lane) {
      const int vertex = tile * kLanes + lane;
      if (vertex < first || vertex >= first + count) continue;
      double value = prior_correlations[lane] + covariance[lane];
      if (belief_.sharp_.size() > 0) {  // no more than the variances allow
        const double most = std::sqrt(belief_.sharp_[vertex_] * belief_.sharp_[vertex]);
        value = vertex == vertex_ ? most : std::clamp(value, -most, most);
      }
      out[vertex - first] = signal_variance * (value + constant_share * (1.0 - belief_.v_ones_[vertex]));
      if (!prior.has_slope()) continue;
      const Vec3 tilt =
          belief_.tilt_residual(prior.coordinates(vertex), belief_.v_tilts_.row(vertex), 1.0 - belief_.v_ones_[vertex], Part::Whole);
      out[vertex - first] += signal_variance * tilt.dot(tilt_weights_);
    }
  }
}

}  // namespace palpation
