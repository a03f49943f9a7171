#include "palpation/belief/belief.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "belief/reduced.h"
#include "belief/rows.h"
#include "belief/seen.h"
#include "palpation/base/error.h"
#include "readings/readings.h"

namespace palpation {
namespace {

/// Rows of L alone then take 3 GB.
constexpr std::size_t kMostSites = 20000;
/// Noise over the signal's variance with which a reading may have a row beside another of the same
/// place: its pivot keeps ten digits.
constexpr double kLeastNoiseOfRepeat = 1e-6;

double mean_of(const Eigen::VectorXd& values) {
  const double origin = values[0];
  return origin + (values.array() - origin).sum() / static_cast<double>(values.size());
}

}  // namespace

Belief::Belief(Prior prior, const BeliefOptions& options)
    : prior_(std::move(prior)), options_(options) {
  require(std::isfinite(options.noise_sd) && options.noise_sd >= 0.0, "Belief",
          "noise_sd = " + text_of(options.noise_sd), "must be finite and not negative");
  const double tolerance = options.reduced_rank_tolerance;
  require(tolerance == 0.0 || (tolerance >= 1e-13 && tolerance <= 1e-4), "Belief",
          "reduced_rank_tolerance = " + text_of(tolerance), "must be 0 or from 1e-13 to 1e-4");
  restate_readings();
  restate_constant();
  restate_slope();
}

double Belief::signal_sd() const { return prior_.kernel().signal_sd * spread_; }

double Belief::noise_variance() const {
  const double sd =
      options_.noise_is_relative ? options_.noise_sd * signal_sd() : options_.noise_sd;
  return sd * sd;
}

int Belief::site_count() const {
  return reduced_ ? reduced_->site_count : static_cast<int>(sites_.size());
}

int Belief::row_count() const {
  return rows_.empty() ? 0 : rows_.back()->first + rows_.back()->count;
}

Belief Belief::condition_on(std::span<const Palpation> more) const {
  Belief next = *this;
  next.palpations_.insert(next.palpations_.end(), more.begin(), more.end());
  if (next.reduce(more.size())) {
    next.foreseen_.reset();
    return next;
  }
  if (reduced_) next.keep_rows(0);
  next.restate_sites(reduced_ ? next.palpations_.size() : more.size());
  next.restate_readings();
  int unchanged = 0;
  const int known = std::min(row_count(), next.site_count());
  while (unchanged < known && next.sites_[unchanged].place == sites_[unchanged].place &&
         next.diagonal_[unchanged] == diagonal_[unchanged] &&
         next.readings_[unchanged] == readings_[unchanged]) {
    ++unchanged;
  }
  if (unchanged < row_count()) next.keep_rows(unchanged);
  next.append_foreseen();
  next.append_rows(Keep::Rows);
  next.sharpen();
  next.restate_constant();
  next.restate_slope();
  return next;
}

void Belief::restate_spread() {
  if (!options_.standardize) return;
  const std::vector<double> used = used_readings(palpations_);
  if (used.empty()) return;
  const Eigen::Map<const Eigen::VectorXd> readings(used.data(),
                                                   static_cast<Eigen::Index>(used.size()));
  centre_ = mean_of(readings);
  const double spread = std::sqrt((readings.array() - centre_).square().mean());
  require(
      (spread > 1e-150 && spread < 1e150) || readings.minCoeff() == readings.maxCoeff(), "Belief",
      "readings between " + text_of(readings.minCoeff()) + " and " + text_of(readings.maxCoeff()),
      "cannot be standardized: the square of their spread must be a number");
  spread_ = spread > 0.0 ? spread : 1.0;
}

/// What readings are counted from where a constant takes up the difference.
void Belief::state_origin(std::span<const Site> sites) {
  if (!sites.empty())
    origin_ = options_.standardize || prior_.constant().sd > 0.0
                  ? merge(sites.front(), noise_variance()).mean
                  : 0.0;
}

/// The sites of all readings, the last `more` of which are new. A place that is touched again has a
/// site of its own, so that the rows that stand remain; only where repeats are as many as places,
/// or so exact that the rows of both would all but coincide, are all merged anew.
void Belief::restate_sites(std::size_t more) {
  const std::vector<Site> fresh = gather_sites(prior_, palpations_, palpations_.size() - more);
  restate_spread();
  const double signal_variance = signal_sd() * signal_sd();
  bool may_repeat = true;
  int repeats = repeat_count_;
  for (const Site& site : fresh) {
    if (std::ranges::none_of(sites_, [&](const Site& known) { return known.place == site.place; }))
      continue;
    ++repeats;
    may_repeat = may_repeat &&
                 merge(site, noise_variance()).variance >= kLeastNoiseOfRepeat * signal_variance;
  }
  if (may_repeat && 2 * repeats <= static_cast<int>(sites_.size() + fresh.size()) &&
      sites_.size() + fresh.size() <= kMostSites) {
    sites_.insert(sites_.end(), fresh.begin(), fresh.end());
    repeat_count_ = repeats;
  } else {
    sites_ = gather_sites(prior_, palpations_);
    repeat_count_ = 0;
  }
}

/// The sites' merged readings and the diagonal D.
void Belief::restate_readings() {
  require(sites_.size() <= kMostSites, "Belief", std::to_string(sites_.size()) + " places touched",
          "must be at most " + std::to_string(kMostSites) +
              " for an exact belief; one of reduced rank takes more");
  const double signal_variance = signal_sd() * signal_sd();
  const double plain_ratio = options_.noise_is_relative ? options_.noise_sd * options_.noise_sd
                                                        : noise_variance() / signal_variance;
  require(!options_.single_precision || sites_.empty() || plain_ratio >= kLeastNoiseForSingle,
          "Belief",
          "single precision where noise is " + text_of(std::sqrt(plain_ratio)) +
              " of the signal (standard deviations)",
          "needs " + text_of(std::sqrt(kLeastNoiseForSingle)) + " at least: take double");
  readings_.clear();
  diagonal_.clear();
  for (const Site& site : sites_) {
    const MergedReading merged = merge(site, noise_variance());
    readings_.push_back(merged.mean);
    diagonal_.push_back(site.known.empty() ? plain_ratio / static_cast<double>(site.plain.size())
                                           : merged.variance / signal_variance);
  }
  if (row_count() == 0) state_origin(sites_);
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
  constant_ = constant_precision_ > 0.0
                  ? origin_ + (prior_precision * (centre_ - origin_) + ones_.dot(whitened_)) /
                                  constant_precision_
                  : centre_;
}

bool Belief::constant_is_unsure() const {
  return std::isfinite(constant_precision_) && constant_precision_ > 0.0;
}

/// Posterior of the slope once the constant is integrated out: B = signal^2 I + W'W - W'1 1'W /
/// (the constant's precision), W = tilts_.
void Belief::restate_slope() {
  if (!prior_.has_slope()) return;
  const double slope_precision =
      prior_.kernel().signal_sd *
      prior_.kernel().signal_sd;  // of a prior of unit variance, over the signal's
  const Vec3 along_ones = tilts_.transpose() * ones_;
  constant_per_tilt_ =
      constant_is_unsure() ? Vec3(along_ones / constant_precision_) : Vec3(Vec3::Zero());
  Eigen::Matrix3d precision =
      tilts_.transpose() * tilts_ - along_ones * constant_per_tilt_.transpose();
  precision.diagonal().array() += slope_precision;
  tilt_covariance_ = precision.llt().solve(Eigen::Matrix3d::Identity());
  tilt_ = tilt_covariance_ * (tilts_.transpose() * (whitened_ - (constant_ - origin_) * ones_));
}

Vec3 Belief::slope() const { return prior_.slope().sd.cwiseProduct(tilt_); }

std::vector<Palpation> Belief::detrended_palpations() const {
  std::vector<Palpation> detrended = palpations_;
  if (!prior_.has_slope()) return detrended;
  for (Palpation& palpation : detrended)
    palpation.reading -= tilt_.dot(prior_.tilt(prior_.coordinates(palpation.where)));
  return detrended;
}

double Belief::log_marginal_likelihood() const {
  const double signal_variance = signal_sd() * signal_sd();
  const int n = site_count();
  if (n == 0) return 0.0;
  const double prior_sd = prior_.constant().sd * (options_.standardize ? spread_ : 1.0);
  double log_determinant = n * std::log(signal_variance);
  if (reduced_) log_determinant += reduced_->weights.log_determinant();
  for (const auto& rows : rows_) {
    for (int row = 0; row < rows->count; ++row)
      log_determinant += 2.0 * std::log(rows->factor(row, rows->first + row));
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
    log_determinant -= std::log(tilt_covariance_.determinant()) +
                       3.0 * std::log(prior_.kernel().signal_sd * prior_.kernel().signal_sd);
  }
  double result = -0.5 * (square / signal_variance + log_determinant +
                          free_readings * std::log(2.0 * std::numbers::pi));
  if (reduced_) result += reduced_->scatter;
  for (const Site& site : sites_) result += scatter_log_likelihood(site, noise_variance());
  return result;
}

}  // namespace palpation
