#include "palpation/base/positive_definite.h"

#include <algorithm>
#include <cmath>

#include "palpation/base/tile.h"

namespace palpation {
namespace {

/// Cholesky's factor of eight rows and columns; false if a pivot is not positive.
bool factor_block(double* block, long stride) {
  for (int j = 0; j < kLanes; ++j) {
    for (int i = j; i < kLanes; ++i) {
      double rest = block[i * stride + j];
      for (int k = 0; k < j; ++k) rest -= block[i * stride + k] * block[j * stride + k];
      if (i == j) {
        if (!(rest > 0.0) || !std::isfinite(rest)) return false;
        block[j * stride + j] = std::sqrt(rest);
      } else {
        block[i * stride + j] = rest / block[j * stride + j];
      }
    }
  }
  return true;
}

}  // namespace

void PositiveDefiniteInverse::resize(long size) {
  stride_ = (size + kLanes - 1) / kLanes * kLanes;
  for (std::vector<double>* square : {&factor_, &transposed_}) square->resize(static_cast<std::size_t>(stride_ * stride_));
  for (std::vector<double>* columns : {&tile_, &products_}) columns->resize(static_cast<std::size_t>(stride_ * kLanes));
}

/// Eight rows from `first` on are the tile's columns; its rows stand for `from` to `to`.
void PositiveDefiniteInverse::take_columns(std::vector<double>& rows, long first, long from, long to) const {
  for (int lane = 0; lane < kLanes; ++lane) {
    double* row = rows.data() + (first + lane) * stride_;
    for (long i = from; i < to; ++i) row[i] = tile_[static_cast<std::size_t>((i - from) * kLanes + lane)];
  }
}

/// Eight columns at a time: what the rows above leave of them, and their own triangle.
bool PositiveDefiniteInverse::factorize(const Eigen::MatrixXd& matrix) {
  const int stride = static_cast<int>(stride_);
  for (long first = 0; first < stride_; first += kLanes) {
    const long given = std::min<long>(kLanes, matrix.rows() - first);
    std::fill(tile_.begin(), tile_.end(), 0.0);
    for (long i = 0; i < first; ++i) std::copy_n(matrix.col(i).data() + first, given, tile_.data() + i * kLanes);
    for (long i = 0; i < given; ++i) {
      for (long lane = 0; lane < given; ++lane)
        tile_[static_cast<std::size_t>((first + i) * kLanes + lane)] = matrix(first + std::max(i, lane), first + std::min(i, lane));
    }
    for (long lane = given; lane < kLanes; ++lane) tile_[static_cast<std::size_t>((first + lane) * kLanes + lane)] = 1.0;
    solve_triangle(factor_.data(), stride, tile_.data(), static_cast<int>(first));
    take_columns(factor_, first, 0, first);
    double* own = tile_.data() + first * kLanes;
    double* rows = factor_.data() + first * stride_;
    subtract_product(rows, stride, tile_.data(), static_cast<int>(first), own, kLanes);
    for (int row = 0; row < kLanes; ++row) std::copy_n(own + row * kLanes, kLanes, rows + row * stride_ + first);
    if (!factor_block(rows + first, stride_)) return false;
  }
  return true;
}

std::optional<double> PositiveDefiniteInverse::operator()(Eigen::MatrixXd& matrix) {
  const long size = matrix.rows();
  resize(size);
  if (!factorize(matrix)) return std::nullopt;
  double log_determinant = 0.0;
  for (long i = 0; i < size; ++i) log_determinant += 2.0 * std::log(factor_[static_cast<std::size_t>(i * (stride_ + 1))]);

  // Of X = L^-1 eight columns at a time; X'X has the columns' products with those before and themselves.
  const int stride = static_cast<int>(stride_);
  for (long first = 0; first < stride_; first += kLanes) {
    std::fill(tile_.begin(), tile_.end(), 0.0);
    for (int lane = 0; lane < kLanes; ++lane) tile_[static_cast<std::size_t>(lane * kLanes + lane)] = 1.0;
    const int rest = static_cast<int>(stride_ - first);
    solve_triangle(factor_.data() + first * (stride_ + 1), stride, tile_.data(), rest);
    take_columns(transposed_, first, first, stride_);
    std::fill(products_.begin(), products_.end(), 0.0);
    subtract_product(transposed_.data() + first, stride, tile_.data(), rest, products_.data(), static_cast<int>(first) + kLanes);
    for (long i = 0; i < std::min(first + kLanes, size); ++i) {
      for (long lane = std::max(0L, i - first); lane < std::min<long>(kLanes, size - first); ++lane)
        matrix(first + lane, i) = -products_[static_cast<std::size_t>(i * kLanes + lane)];
    }
  }
  return log_determinant;
}

}  // namespace palpation
