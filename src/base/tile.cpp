#include "palpation/base/tile.h"

#include <cstring>

#include "palpation/base/targets.h"

namespace palpation {
namespace {

using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));
constexpr int kRowsAtOnce = 4;

}  // namespace

PALPATION_TARGETS void subtract_product(const double* factor, int stride, const double* tile, int depth, double* fresh, int rows) {
  int row = 0;
  for (; row + kRowsAtOnce <= rows; row += kRowsAtOnce) {
    Lanes sums[kRowsAtOnce];
    std::memcpy(sums, fresh + row * kLanes, sizeof sums);
    const double* weights = factor + row * static_cast<long>(stride);
    for (int i = 0; i < depth; ++i) {
      Lanes values;
      std::memcpy(&values, tile + i * kLanes, sizeof values);
      for (int r = 0; r < kRowsAtOnce; ++r) sums[r] -= weights[r * static_cast<long>(stride) + i] * values;
    }
    std::memcpy(fresh + row * kLanes, sums, sizeof sums);
  }
  for (; row < rows; ++row) {
    Lanes sum;
    std::memcpy(&sum, fresh + row * kLanes, sizeof sum);
    for (int i = 0; i < depth; ++i) {
      Lanes values;
      std::memcpy(&values, tile + i * kLanes, sizeof values);
      sum -= factor[row * static_cast<long>(stride) + i] * values;
    }
    std::memcpy(fresh + row * kLanes, &sum, sizeof sum);
  }
}

void solve_triangle(const double* factor, int stride, double* fresh, int rows) {
  for (int first = 0; first < rows; first += kRowsAtOnce) {
    const int count = first + kRowsAtOnce <= rows ? kRowsAtOnce : rows - first;
    subtract_product(factor + first * static_cast<long>(stride), stride, fresh, first, fresh + first * kLanes, count);
    for (int row = first; row < first + count; ++row) {
      const double* weights = factor + row * static_cast<long>(stride);
      double* target = fresh + row * kLanes;
      for (int i = first; i < row; ++i) {
        for (int lane = 0; lane < kLanes; ++lane) target[lane] -= weights[i] * fresh[i * kLanes + lane];
      }
      for (int lane = 0; lane < kLanes; ++lane) target[lane] /= weights[row];
    }
  }
}

}  // namespace palpation
