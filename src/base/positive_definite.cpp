#include "palpation/base/positive_definite.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "palpation/base/tile.h"

namespace palpation {
namespace {

/// A matrix in rows, padded to whole tiles; what is beyond its size is the identity.
class Padded {
 public:
  explicit Padded(Eigen::Index size) : stride((size + kLanes - 1) / kLanes * kLanes), values_(static_cast<std::size_t>(stride * stride)) {}

  double* row(long number) { return values_.data() + number * stride; }
  const double* row(long number) const { return values_.data() + number * stride; }

  /// Eight rows from `first` on are the tile's columns; its rows stand for `from` to `to`.
  void take_columns(long first, long from, long to, const double* tile) {
    for (long i = from; i < to; ++i) {
      for (int lane = 0; lane < kLanes; ++lane) row(first + lane)[i] = tile[(i - from) * kLanes + lane];
    }
  }

  const long stride;

 private:
  std::vector<double> values_;
};

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

/// Eight columns at a time: what the rows above leave of them, and their own triangle.
bool factorize(const Eigen::MatrixXd& matrix, Padded& factor) {
  const long size = matrix.rows();
  std::vector<double> tile(static_cast<std::size_t>(factor.stride * kLanes));
  const auto value = [&](long i, long j) { return i < size && j < size ? matrix(i, j) : (i == j ? 1.0 : 0.0); };
  for (long first = 0; first < factor.stride; first += kLanes) {
    for (long i = 0; i < first + kLanes; ++i) {
      for (int lane = 0; lane < kLanes; ++lane) tile[static_cast<std::size_t>(i * kLanes + lane)] = value(i, first + lane);
    }
    solve_triangle(factor.row(0), static_cast<int>(factor.stride), tile.data(), static_cast<int>(first));
    factor.take_columns(first, 0, first, tile.data());
    double* own = tile.data() + first * kLanes;
    subtract_product(factor.row(first), static_cast<int>(factor.stride), tile.data(), static_cast<int>(first), own, kLanes);
    for (int row = 0; row < kLanes; ++row) std::copy(own + row * kLanes, own + row * kLanes + kLanes, factor.row(first + row) + first);
    if (!factor_block(factor.row(first) + first, factor.stride)) return false;
  }
  return true;
}

}  // namespace

std::optional<double> invert_positive_definite(Eigen::MatrixXd& matrix) {
  const long size = matrix.rows();
  Padded factor(size);
  if (!factorize(matrix, factor)) return std::nullopt;
  double log_determinant = 0.0;
  for (long i = 0; i < size; ++i) log_determinant += 2.0 * std::log(factor.row(i)[i]);

  // Of X = L^-1 eight columns at a time; X'X has the columns' products with those before and themselves.
  Padded transposed(size);
  std::vector<double> tile(static_cast<std::size_t>(factor.stride * kLanes)), products(tile.size());
  for (long first = 0; first < factor.stride; first += kLanes) {
    std::fill(tile.begin(), tile.end(), 0.0);
    for (int lane = 0; lane < kLanes; ++lane) tile[static_cast<std::size_t>(lane * kLanes + lane)] = 1.0;
    solve_triangle(factor.row(first) + first, static_cast<int>(factor.stride), tile.data(), static_cast<int>(factor.stride - first));
    transposed.take_columns(first, first, factor.stride, tile.data());
    std::fill(products.begin(), products.end(), 0.0);
    subtract_product(transposed.row(0) + first, static_cast<int>(factor.stride), tile.data(), static_cast<int>(factor.stride - first),
                     products.data(), static_cast<int>(first) + kLanes);
    for (int lane = 0; lane < kLanes && first + lane < size; ++lane) {
      for (long i = 0; i <= first + lane; ++i)
        matrix(i, first + lane) = matrix(first + lane, i) = -products[static_cast<std::size_t>(i * kLanes + lane)];
    }
  }
  return log_determinant;
}

}  // namespace palpation
