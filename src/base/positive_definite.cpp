#include "base/positive_definite.h"

#include <algorithm>
#include <cmath>

#include "base/cholesky.h"
#include "base/tile.h"

namespace palpation {

void PositiveDefiniteInverse::resize(long size) {
  stride_ = (size + kLanes - 1) / kLanes * kLanes;
  for (std::vector<double>* square : {&factor_, &transposed_})
    square->resize(static_cast<std::size_t>(stride_ * stride_));
  for (std::vector<double>* columns : {&tile_, &products_})
    columns->resize(static_cast<std::size_t>(stride_ * kLanes));
}

bool PositiveDefiniteInverse::factorize(const Eigen::MatrixXd& matrix) {
  const long size = matrix.rows();
  for (long first = 0; first < stride_; first += kLanes) {
    double* rows = factor_.data() + first * stride_;
    const long given = std::min<long>(kLanes, size - first);
    for (long column = 0; column < first + given; ++column) {
      const double* values = matrix.col(column).data() + first;
      for (long lane = 0; lane < given; ++lane) rows[lane * stride_ + column] = values[lane];
    }
    for (long lane = given; lane < kLanes; ++lane) {
      std::fill_n(rows + lane * stride_, first + lane, 0.0);
      rows[lane * stride_ + first + lane] = 1.0;
    }
  }
  return palpation::factorize(factor_.data(), stride_, stride_) == stride_;
}

std::optional<double> PositiveDefiniteInverse::operator()(Eigen::MatrixXd& matrix) {
  const long size = matrix.rows();
  resize(size);
  if (!factorize(matrix)) return std::nullopt;
  double log_determinant = 0.0;
  for (long i = 0; i < size; ++i) log_determinant += 2.0 * std::log(factor_[i * (stride_ + 1)]);

  // Of X = L^-1 eight columns at a time; X'X has the columns' products with those before and
  // themselves.
  const int stride = static_cast<int>(stride_);
  for (long first = 0; first < stride_; first += kLanes) {
    std::fill(tile_.begin(), tile_.end(), 0.0);
    for (int lane = 0; lane < kLanes; ++lane) tile_[lane * kLanes + lane] = 1.0;
    const int rest = static_cast<int>(stride_ - first);
    solve_triangle(factor_.data() + first * (stride_ + 1), stride, tile_.data(), rest);
    for (int lane = 0; lane < kLanes; ++lane) {
      double* row = transposed_.data() + (first + lane) * stride_ + first;
      for (long i = 0; i < rest; ++i) row[i] = tile_[i * kLanes + lane];
    }
    std::fill(products_.begin(), products_.end(), 0.0);
    subtract_product(transposed_.data() + first, stride, tile_.data(), rest, products_.data(),
                     static_cast<int>(first) + kLanes);
    for (long i = 0; i < std::min(first + kLanes, size); ++i) {
      for (long lane = std::max(0L, i - first); lane < std::min<long>(kLanes, size - first); ++lane)
        matrix(first + lane, i) = -products_[i * kLanes + lane];
    }
  }
  return log_determinant;
}

}  // namespace palpation
