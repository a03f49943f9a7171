#include "belief/exact_engine.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "palpation/base/error.h"

namespace palpation {
namespace {

/// Rows of L alone then take 3 GB.
constexpr std::size_t kMostSites = 20000;
/// Noise over the signal's variance with which a reading may have a row beside another of the same
/// place: its pivot keeps ten digits.
constexpr double kLeastNoiseOfRepeat = 1e-6;

}  // namespace

int ExactEngine::row_count() const {
  return rows_.empty() ? 0 : rows_.back()->first + rows_.back()->count;
}

ExactEngine ExactEngine::after(ScaledPrior& field, std::span<const Palpation> palpations,
                               std::size_t more, Keep keep) const {
  ExactEngine next = *this;
  next.restate_sites(field, palpations, more);
  next.restate_readings(field);
  int unchanged = 0;
  const int known = std::min(row_count(), next.site_count());
  while (unchanged < known && next.sites_[unchanged].place == sites_[unchanged].place &&
         next.diagonal_[unchanged] == diagonal_[unchanged] &&
         next.readings_[unchanged] == readings_[unchanged]) {
    ++unchanged;
  }
  if (unchanged < row_count()) next.keep_rows(field.prior, unchanged);
  next.append_foreseen(field.prior);
  // Where there is little noise the rows are looked at again.
  next.append_rows(field, next.least_noise_ < kSmallNoise ? Keep::Rows : keep);
  next.sharpen(field.prior);
  return next;
}

/// The sites of all readings, the last `more` of which are new. A place that is touched again has a
/// site of its own, so that the rows that stand remain; only where repeats are as many as places,
/// or so exact that the rows of both would all but coincide, are all merged anew.
void ExactEngine::restate_sites(ScaledPrior& field, std::span<const Palpation> palpations,
                                std::size_t more) {
  const std::vector<Site> fresh = gather_sites(field.prior, palpations, palpations.size() - more);
  field.standardize(palpations);
  bool may_repeat = true;
  int repeats = repeat_count_;
  for (const Site& site : fresh) {
    if (std::ranges::none_of(sites_, [&](const Site& known) { return known.place == site.place; }))
      continue;
    ++repeats;
    may_repeat = may_repeat && merge(site, field.noise_variance()).variance >=
                                   kLeastNoiseOfRepeat * field.signal_variance();
  }
  if (may_repeat && 2 * repeats <= static_cast<int>(sites_.size() + fresh.size()) &&
      sites_.size() + fresh.size() <= kMostSites) {
    sites_.insert(sites_.end(), fresh.begin(), fresh.end());
    repeat_count_ = repeats;
  } else {
    sites_ = gather_sites(field.prior, palpations);
    repeat_count_ = 0;
  }
}

/// The sites' merged readings and the diagonal D.
void ExactEngine::restate_readings(const ScaledPrior& field) {
  require(sites_.size() <= kMostSites, "Belief", std::to_string(sites_.size()) + " places touched",
          "must be at most " + std::to_string(kMostSites) +
              " for an exact belief; one of reduced rank takes more");
  const BeliefOptions& options = field.options;
  const double plain_ratio = options.noise_is_relative
                                 ? options.noise_sd * options.noise_sd
                                 : field.noise_variance() / field.signal_variance();
  require(!options.single_precision || sites_.empty() || plain_ratio >= kLeastNoiseForSingle,
          "Belief",
          "single precision where noise is " + text_of(std::sqrt(plain_ratio)) +
              " of the signal (standard deviations)",
          "needs " + text_of(std::sqrt(kLeastNoiseForSingle)) + " at least: take double");
  readings_.clear();
  diagonal_.clear();
  for (const Site& site : sites_) {
    const MergedReading merged = merge(site, field.noise_variance());
    readings_.push_back(merged.mean);
    diagonal_.push_back(site.known.empty() ? plain_ratio / static_cast<double>(site.plain.size())
                                           : merged.variance / field.signal_variance());
  }
  least_noise_ = diagonal_.empty() ? 1.0 : *std::ranges::min_element(diagonal_);
  if (row_count() == 0 && !sites_.empty()) whitened_.origin = field.origin(sites_);
}

Eigen::VectorXd ExactEngine::solve_lower(Eigen::VectorXd right_side) const {
  for (const auto& rows : rows_) {
    auto part = right_side.segment(rows->first, rows->count);
    part.noalias() -= rows->factor.leftCols(rows->first) * right_side.head(rows->first);
    rows->factor.rightCols(rows->count).triangularView<Eigen::Lower>().solveInPlace(part);
  }
  return right_side;
}

/// Since K >= k k', the variance is at least s / (s + |k|^2), s the least noise.
void ExactEngine::unexplained(const VertexTiles& tiles, int tile, double* of_lanes) const {
  const double* sums = sums_->tile(tile);
  const int* vertices = tiles.vertices(tile);
  for (int lane = 0; lane < kLanes; ++lane) {
    const double covered = sums[sums_->covered() * kLanes + lane];
    const double floor = least_noise_ > 0.0 ? least_noise_ / (least_noise_ + covered) : 0.0;
    const double left = sharp_.size() == 0 ? 1.0 - sums[VertexSums::kExplained * kLanes + lane]
                                           : sharp_[vertices[lane]];
    of_lanes[lane] = std::min(std::max(left, floor), 1.0);
  }
}

std::vector<TileRows> ExactEngine::rows() const {
  std::vector<TileRows> all;
  for (const auto& rows : rows_) all.push_back(rows->strip());
  return all;
}

std::vector<double> ExactEngine::column(const VertexTiles& tiles, int vertex) const {
  std::vector<double> column;
  column.reserve(sites_.size());
  const int place = tiles.place(vertex);
  for (const auto& rows : rows_) {
    for (int row = 0; row < rows->count; ++row) column.push_back(rows->value(row, place));
  }
  return column;
}

double ExactEngine::held(double correlation, int a, int b) const {
  if (sharp_.size() == 0) return correlation;
  const double most = std::sqrt(sharp_[a] * sharp_[b]);
  return a == b ? most : std::clamp(correlation, -most, most);
}

double ExactEngine::plus_log_determinant(double sum) const {
  for (const auto& rows : rows_) {
    for (int row = 0; row < rows->count; ++row)
      sum += 2.0 * std::log(rows->factor(row, rows->first + row));
  }
  return sum;
}

double ExactEngine::plus_scatter(double sum, double noise_variance) const {
  for (const Site& site : sites_) sum += scatter_log_likelihood(site, noise_variance);
  return sum;
}

}  // namespace palpation
