// How the exact engine grows: rows of L for new sites, what they say of the readings, and rows of V
// with their share of the sums at the vertices, in one pass over these.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/cholesky.h"
#include "belief/correlations.h"
#include "belief/exact_engine.h"
#include "belief/field_not_fitted.h"
#include "palpation/base/error.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

constexpr int kGroupsAtOnce = 8;
/// So many rows of L are appended one by one; more, eight at a time.
constexpr int kFewRows = 256;

using Factor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Strips of no more than kDepthTogether rows in all, and the factor's column where they begin.
struct Chunk {
  int column = 0;
  std::vector<TileRows> strips;
};

std::vector<Chunk> chunks_of(std::span<const TileRows> known) {
  std::vector<Chunk> chunks;
  int depth = 0;
  for (TileRows strip : known) {
    while (strip.depth > 0) {
      const int room = kDepthTogether - depth % kDepthTogether, taken = std::min(room, strip.depth);
      if (room == kDepthTogether) chunks.push_back({depth, {}});
      chunks.back().strips.push_back(strip);
      chunks.back().strips.back().depth = taken;
      strip = strip.without_first(taken);
      depth += taken;
    }
  }
  return chunks;
}

/// Rows of V on a group of tiles, from the correlations that stand in them: row-wise forward
/// substitution, a panel of rows at a time.
class Substitution {
 public:
  Substitution(const Factor& factor, std::span<const TileRows> known)
      : rows_(static_cast<int>(factor.rows())),
        factor_(factor.data(), factor.cols(), rows_, factor.cols()),
        known_(chunks_of(known)) {}

  /// `fresh`: of the first tile of the group; the next follow, all rows of each together.
  void operator()(int first_tile, int tile_count, double* fresh) const {
    const long per_tile = static_cast<long>(rows_) * kLanes;
    for (int row = 0; row < rows_; row += factor_.height()) {
      double* target = fresh + static_cast<long>(row) * kLanes;
      for (const Chunk& chunk : known_) {
        subtract_packed(factor_.panel(row, chunk.column, false), chunk.strips.data(),
                        static_cast<int>(chunk.strips.size()), first_tile, tile_count, target,
                        per_tile);
      }
    }
    solve_triangle(factor_, fresh, tile_count, per_tile);
  }

 private:
  int rows_;
  PackedFactor factor_;
  std::vector<Chunk> known_;
};

/// Row `row` of the factor of `first` columns more than rows, whose own triangle still has the
/// covariance; returns the pivot.
double append_row(Factor& factor, int row, int first) {
  for (int column = 0; column < row; ++column) {
    const double rest =
        factor(row, first + column) -
        factor.row(row).head(first + column).dot(factor.row(column).head(first + column));
    factor(row, first + column) = rest / factor(column, first + column);
  }
  const double pivot = factor(row, first + row) -
                       factor.row(row).head(first + row).dot(factor.row(row).head(first + row));
  factor(row, first + row) = std::sqrt(pivot);
  return pivot;
}

}  // namespace

/// L^-1 of 1, the readings and the tilts at `count` sites from `first` on, a row each.
Eigen::MatrixXd ExactEngine::whitened_rows(int first, int count) const {
  const Eigen::Index tilts = whitened_.tilts.rows() > 0 ? 3 : 0;
  Eigen::MatrixXd right_sides(count, 2 + tilts);
  right_sides.col(0) = whitened_.ones.segment(first, count);
  right_sides.col(1) = whitened_.readings.segment(first, count);
  if (tilts > 0) right_sides.rightCols(tilts) = whitened_.tilts.middleRows(first, count);
  return right_sides;
}

/// Forgets the rows from the first one that does not lie in a block before `count`, and restates
/// the sums over the rest.
void ExactEngine::keep_rows(const Prior& prior, int count) {
  while (!rows_.empty() && row_count() > count) rows_.pop_back();
  if (prior.has_slope()) whitened_.tilts.conservativeResize(row_count(), 3);
  whitened_.ones.conservativeResize(row_count());
  whitened_.readings.conservativeResize(row_count());
  sums_.reset();
  if (rows_.empty()) return;
  const VertexTiles& tiles = prior.tiles();
  const TileCorrelations correlations(prior, std::span(sites_).first(row_count()));
  auto sums = std::make_shared<VertexSums>(tiles.count(), prior.has_slope());
  const Eigen::MatrixXd solutions = whitened_rows(0, row_count());
  for_ranges(tiles.count(), kTilesTogether * kGroupsAtOnce, [&](int first_tile, int last_tile) {
    const AlignedDoubles k = aligned_doubles(static_cast<std::size_t>(row_count()) * kLanes);
    const AlignedDoubles widened = aligned_doubles(static_cast<std::size_t>(row_count()) * kLanes);
    for (int tile = first_tile; tile < last_tile; ++tile) {
      double* sum = sums->tile(tile);
      std::fill(sum, sum + sums->width * kLanes, 0.0);
      correlations(tile, 1, k.get());
      add_sums(k.get(), row_count(), nullptr, 0, 0, sum + sums->covered() * kLanes);
      for (const auto& rows : rows_) {
        add_sums(rows->tile(tile, widened.get()), rows->count, solutions.data() + rows->first,
                 solutions.rows(), static_cast<int>(solutions.cols()), sum);
      }
    }
  });
  sums_ = std::move(sums);
}

/// The rows of L for the sites from `fresh.first` on: row-append Cholesky, which is as accurate as
/// factoring anew.
void ExactEngine::append_to_factor(const Prior& prior, FactorRows& fresh) const {
  const int first = fresh.first, count = fresh.count;
  Eigen::MatrixXd correlations = palpation::correlations(prior, prior.kernel(), sites_, first);
  for (int j = 0; j < count; ++j) correlations(first + j, j) += diagonal_[first + j];
  for (const auto& rows : rows_) {
    auto right_side = correlations.middleRows(rows->first, rows->count);
    right_side.noalias() -= rows->factor.leftCols(rows->first) * correlations.topRows(rows->first);
    rows->factor.rightCols(rows->count).triangularView<Eigen::Lower>().solveInPlace(right_side);
  }
  auto& factor = fresh.factor;
  factor.resize(count, first + count);
  factor.leftCols(first) = correlations.topRows(first).transpose();
  factor.rightCols(count) = correlations.bottomRows(count).transpose();
  correlations.resize(0, 0);
  int done = 0;
  double pivot = 0.0;
  if (count <= kFewRows) {
    for (; done < count; ++done) {
      pivot = append_row(factor, done, first);
      if (!(pivot > 0.0) || !std::isfinite(pivot)) break;
    }
  } else {
    if (first > 0)
      factor.rightCols(count).noalias() -=
          factor.leftCols(first) * factor.leftCols(first).transpose();
    done = static_cast<int>(factorize(factor.data() + first, factor.cols(), count));
    if (done < count) pivot = factor(done, first + done);
  }
  factor.rightCols(count).triangularView<Eigen::StrictlyUpper>().setZero();
  if (done == count) return;
  throw FieldNotFitted("Belief", "site " + std::to_string(first + done) + " leaves the pivot " +
                                     text_of(pivot) +
                                     ", so the covariance is not positive definite in double "
                                     "precision: sites all but coincide, "
                                     "and the noise (" +
                                     text_of(diagonal_[first + done]) +
                                     " of the signal's variance) does not part them");
}

/// L^-1 of 1, the readings and the tilts.
void ExactEngine::append_to_whitened(const Prior& prior, const FactorRows& fresh) {
  const auto& factor = fresh.factor;
  const int first = fresh.first, total = first + fresh.count;
  auto& [ones, readings, tilts, origin] = whitened_;
  ones.conservativeResize(total);
  readings.conservativeResize(total);
  if (prior.has_slope()) tilts.conservativeResize(total, 3);
  for (int row = first; row < total; ++row) {
    const auto before = factor.row(row - first).head(row);
    const double pivot = factor(row - first, row);
    ones[row] = (1.0 - before.dot(ones.head(row))) / pivot;
    readings[row] = (readings_[row] - origin - before.dot(readings.head(row))) / pivot;
    if (!prior.has_slope()) continue;
    const Vec3 tilt = prior.tilt(sites_[row].place.coordinates);
    tilts.row(row) = (tilt.transpose() - before * tilts.topRows(row)) / pivot;
  }
}

void ExactEngine::append_to_vertices(const ScaledPrior& field, FactorRows& fresh, Keep keep) {
  const VertexTiles& tiles = field.prior.tiles();
  const long per_tile = fresh.per_tile();
  const bool keeps = keep == Keep::Rows, narrows = keeps && field.options.single_precision;
  if (narrows) fresh.singles = aligned<float>(static_cast<std::size_t>(tiles.count() * per_tile));
  if (keeps && !narrows)
    fresh.v = aligned_doubles(static_cast<std::size_t>(tiles.count() * per_tile));
  auto sums = std::make_shared<VertexSums>(tiles.count(), field.prior.has_slope());
  const TileCorrelations correlations(
      field.prior, std::span(sites_).subspan(static_cast<std::size_t>(fresh.first), fresh.count));
  const Eigen::MatrixXd solutions = whitened_rows(fresh.first, fresh.count);
  std::vector<TileRows> known;
  for (const auto& rows : rows_) known.push_back(rows->strip());
  const Substitution substitute(fresh.factor, known);
  for_ranges(tiles.count(), kTilesTogether * kGroupsAtOnce, [&](int begin, int end) {
    AlignedDoubles scratch;
    if (!keeps || narrows)
      scratch = aligned_doubles(static_cast<std::size_t>(kTilesTogether * per_tile));
    for (int first_tile = begin; first_tile < end; first_tile += kTilesTogether) {
      const int count = std::min(kTilesTogether, end - first_tile);
      double* values = scratch ? scratch.get() : fresh.tile(first_tile);
      correlations(first_tile, count, values);
      for (int tile = 0; tile < count; ++tile) {
        double* sum = sums->tile(first_tile + tile);
        if (sums_) {
          std::copy_n(sums_->tile(first_tile + tile), sums->width * kLanes, sum);
        } else {
          std::fill_n(sum, sums->width * kLanes, 0.0);
        }
        add_sums(values + tile * per_tile, fresh.count, nullptr, 0, 0,
                 sum + sums->covered() * kLanes);
      }
      substitute(first_tile, count, values);
      for (int tile = 0; tile < count; ++tile) {
        add_sums(values + tile * per_tile, fresh.count, solutions.data(), solutions.rows(),
                 static_cast<int>(solutions.cols()), sums->tile(first_tile + tile));
      }
      if (narrows)
        std::copy_n(values, count * per_tile, fresh.singles.get() + first_tile * per_tile);
    }
  });
  sums_ = std::move(sums);
}

/// Rows of L and V for all sites that have none yet, and their share of the sums.
void ExactEngine::append_rows(const ScaledPrior& field, Keep keep) {
  if (row_count() == site_count()) return;
  auto fresh = std::make_shared<FactorRows>();
  fresh->first = row_count();
  fresh->count = site_count() - fresh->first;
  append_to_factor(field.prior, *fresh);
  append_to_whitened(field.prior, *fresh);
  append_to_vertices(field, *fresh, keep);
  rows_.push_back(std::move(fresh));
}

}  // namespace palpation
