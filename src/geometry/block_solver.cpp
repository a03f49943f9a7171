#include "geometry/block_solver.h"

#include <cstring>

#include "palpation/base/targets.h"

namespace palpation {
namespace {

constexpr int kHalf = 8;
using Lanes = double __attribute__((vector_size(kHalf * sizeof(double))));
struct Row {
  Lanes low, high;
};

PALPATION_TARGETS void solve_strip(const int* starts, const int* rows, const double* values, const double* inverse_diagonal, int n,
                                   double* x) {
  for (int column = 0; column < n; ++column) {
    Row here;
    std::memcpy(&here, x + static_cast<long>(column) * kStrip, sizeof here);
    for (int k = starts[column]; k < starts[column + 1]; ++k) {
      double* target = x + static_cast<long>(rows[k]) * kStrip;
      Row there;
      std::memcpy(&there, target, sizeof there);
      there.low -= values[k] * here.low;
      there.high -= values[k] * here.high;
      std::memcpy(target, &there, sizeof there);
    }
  }
  for (int column = n - 1; column >= 0; --column) {
    Row here;
    std::memcpy(&here, x + static_cast<long>(column) * kStrip, sizeof here);
    here.low *= inverse_diagonal[column];
    here.high *= inverse_diagonal[column];
    for (int k = starts[column]; k < starts[column + 1]; ++k) {
      Row there;
      std::memcpy(&there, x + static_cast<long>(rows[k]) * kStrip, sizeof there);
      here.low -= values[k] * there.low;
      here.high -= values[k] * there.high;
    }
    std::memcpy(x + static_cast<long>(column) * kStrip, &here, sizeof here);
  }
}

PALPATION_TARGETS void multiply_strip(const int* starts, const int* rows, const double* values, int n, const double* in, double* out) {
  for (int column = 0; column < n; ++column) {
    Row sum{};
    for (int k = starts[column]; k < starts[column + 1]; ++k) {
      Row there;
      std::memcpy(&there, in + static_cast<long>(rows[k]) * kStrip, sizeof there);
      sum.low += values[k] * there.low;
      sum.high += values[k] * there.high;
    }
    std::memcpy(out + static_cast<long>(column) * kStrip, &sum, sizeof sum);
  }
}

/// Four columns of a with eight of b, over rows that stay in the cache.
PALPATION_TARGETS void gram_rows(const double* a, const double* b, long count, double* sums) {
  for (int i = 0; i < kStrip; i += 4) {
    for (int j = 0; j < kStrip; j += kHalf) {
      Lanes sum[4];
      for (int r = 0; r < 4; ++r) std::memcpy(&sum[r], sums + (i + r) * kStrip + j, sizeof(Lanes));
      for (long row = 0; row < count; ++row) {
        Lanes right;
        std::memcpy(&right, b + row * kStrip + j, sizeof right);
        for (int r = 0; r < 4; ++r) sum[r] += a[row * kStrip + i + r] * right;
      }
      for (int r = 0; r < 4; ++r) std::memcpy(sums + (i + r) * kStrip + j, &sum[r], sizeof(Lanes));
    }
  }
}

PALPATION_TARGETS void combine_all(double x, double* a, double y, const double* b, double z, const double* c, long count) {
  for (long i = 0; i < count; ++i) a[i] = x * a[i] + y * b[i] + z * c[i];
}

}  // namespace

void BlockFactor::solve(Strip& strip) const {
  solve_strip(column_starts.data(), rows.data(), values.data(), inverse_diagonal.data(), static_cast<int>(inverse_diagonal.size()),
              strip.data());
}

void multiply(const Eigen::SparseMatrix<double>& a, const Strip& in, Strip& out) {
  out.resize(in.size());
  multiply_strip(a.outerIndexPtr(), a.innerIndexPtr(), a.valuePtr(), static_cast<int>(a.cols()), in.data(), out.data());
}

void add_gram(const double* a, const double* b, long count, double* sums) { gram_rows(a, b, count, sums); }

void combine(double x, Strip& a, double y, const Strip& b, double z, const Strip& c) {
  combine_all(x, a.data(), y, b.data(), z, c.data(), static_cast<long>(a.size()));
}

}  // namespace palpation
