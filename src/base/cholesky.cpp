#include "base/cholesky.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/tile.h"

namespace palpation {
namespace {

/// Cholesky's factor of a few rows and columns; the number of rows that went well.
int factorize_block(double* block, long stride, int size) {
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j <= i; ++j) {
      double rest = block[i * stride + j];
      for (int k = 0; k < j; ++k) rest -= block[i * stride + k] * block[j * stride + k];
      if (j < i) {
        block[i * stride + j] = rest / block[j * stride + j];
      } else {
        const bool is_positive = rest > 0.0 && std::isfinite(rest);
        block[i * stride + i] = is_positive ? std::sqrt(rest) : rest;
        if (!is_positive) return i;
      }
    }
  }
  return size;
}

}  // namespace

/// Eight rows are the columns of a tile: what the rows above leave of them, and their own triangle.
long factorize(double* lower, long stride, long size) {
  std::vector<double> tile(static_cast<std::size_t>((size + kLanes) * kLanes));
  for (long first = 0; first < size; first += kLanes) {
    const int count = static_cast<int>(std::min<long>(kLanes, size - first)),
              depth = static_cast<int>(first);
    double* rows = lower + first * stride;
    for (int lane = 0; lane < count; ++lane) {
      for (long i = 0; i < first; ++i) tile[i * kLanes + lane] = rows[lane * stride + i];
      for (int i = 0; i < count; ++i)
        tile[(first + i) * kLanes + lane] =
            rows[std::max(i, lane) * stride + first + std::min(i, lane)];
    }
    solve_triangle(lower, static_cast<int>(stride), tile.data(), depth);
    for (int lane = 0; lane < count; ++lane) {
      for (long i = 0; i < first; ++i) rows[lane * stride + i] = tile[i * kLanes + lane];
    }
    double* own = tile.data() + first * kLanes;
    subtract_product(rows, static_cast<int>(stride), tile.data(), depth, own, count);
    for (int i = 0; i < count; ++i) std::copy_n(own + i * kLanes, i + 1, rows + i * stride + first);
    const int done = factorize_block(rows + first, stride, count);
    if (done < count) return first + done;
  }
  return size;
}

void TiledLlt::compute(const Eigen::MatrixXd& matrix) {
  m_matrix = matrix;
  const long size = m_matrix.rows();
  m_info = factorize(m_matrix.data(), size, size) == size ? Eigen::Success : Eigen::NumericalIssue;
  m_isInitialized = true;
}

/// Sums of squares of the columns of L^-1, eight of which are a tile.
Eigen::VectorXd TiledLlt::inverse_diagonal() const {
  const long size = m_matrix.rows();
  Eigen::VectorXd diagonal(size);
  std::vector<double> tile;
  for (long first = 0; first < size; first += kLanes) {
    const long rest = size - first, count = std::min<long>(kLanes, rest);
    tile.assign(static_cast<std::size_t>(rest * kLanes), 0.0);
    for (long lane = 0; lane < count; ++lane) tile[lane * kLanes + lane] = 1.0;
    solve_triangle(m_matrix.data() + first * (size + 1), static_cast<int>(size), tile.data(),
                   static_cast<int>(rest));
    const Eigen::Map<const Eigen::Matrix<double, kLanes, Eigen::Dynamic>> columns(tile.data(),
                                                                                  kLanes, rest);
    diagonal.segment(first, count) = columns.rowwise().squaredNorm().head(count);
  }
  return diagonal;
}

}  // namespace palpation
