#include "geometry/block_solver.h"

#include <algorithm>
#include <cstring>

#include "base/targets.h"

namespace palpation {
namespace {

constexpr int kHalf = 8;
constexpr int kWidestPanel = 4;
#define PALPATION_INLINE inline __attribute__((always_inline))

using Lanes = double __attribute__((vector_size(kHalf * sizeof(double))));
struct Row {
  Lanes low, high;
};

/// What the loops over panels read.
struct Columns {
  const int *panel_starts, *starts, *rows;
  const double *values, *inverse_diagonal;
};

/// The rows below a panel of W columns, and each column's values there.
template <int W>
struct Below {
  const int* rows;
  const double* values[W];
  int count;

  Below(const Columns& l, int first)
      : rows(l.rows + l.starts[first + W - 1]),
        count(l.starts[first + W] - l.starts[first + W - 1]) {
    for (int j = 0; j < W; ++j) values[j] = l.values + l.starts[first + j] + (W - 1 - j);
  }
};

/// x <- L^-1 x, as far as the columns of one panel go.
template <int W>
PALPATION_INLINE void solve_forward(const Columns& l, int first, double* x) {
  Row here[W];
  std::memcpy(here, x + static_cast<long>(first) * kStrip, sizeof here);
  for (int j = 0; j < W; ++j) {
    const double* values = l.values + l.starts[first + j];
    for (int i = j + 1; i < W; ++i) {
      here[i].low -= values[i - j - 1] * here[j].low;
      here[i].high -= values[i - j - 1] * here[j].high;
    }
  }
  std::memcpy(x + static_cast<long>(first) * kStrip, here, sizeof here);
  const Below<W> below(l, first);
  for (int k = 0; k < below.count; ++k) {
    double* target = x + static_cast<long>(below.rows[k]) * kStrip;
    Row there;
    std::memcpy(&there, target, sizeof there);
    for (int j = 0; j < W; ++j) {
      there.low -= below.values[j][k] * here[j].low;
      there.high -= below.values[j][k] * here[j].high;
    }
    std::memcpy(target, &there, sizeof there);
  }
}

/// The panel's rows of x <- L'^-1 D^-1 x, where those below are done.
template <int W>
PALPATION_INLINE void solve_backward(const Columns& l, int first, double* x) {
  Row here[W];
  std::memcpy(here, x + static_cast<long>(first) * kStrip, sizeof here);
  for (int j = 0; j < W; ++j) {
    here[j].low *= l.inverse_diagonal[first + j];
    here[j].high *= l.inverse_diagonal[first + j];
  }
  const Below<W> below(l, first);
  for (int k = 0; k < below.count; ++k) {
    Row there;
    std::memcpy(&there, x + static_cast<long>(below.rows[k]) * kStrip, sizeof there);
    for (int j = 0; j < W; ++j) {
      here[j].low -= below.values[j][k] * there.low;
      here[j].high -= below.values[j][k] * there.high;
    }
  }
  for (int j = W - 1; j >= 0; --j) {
    const double* values = l.values + l.starts[first + j];
    for (int i = j + 1; i < W; ++i) {
      here[j].low -= values[i - j - 1] * here[i].low;
      here[j].high -= values[i - j - 1] * here[i].high;
    }
  }
  std::memcpy(x + static_cast<long>(first) * kStrip, here, sizeof here);
}

template <int W, bool kForward>
PALPATION_INLINE void solve_columns(const Columns& l, int first, double* x) {
  if constexpr (kForward) {
    solve_forward<W>(l, first, x);
  } else {
    solve_backward<W>(l, first, x);
  }
}

template <bool kForward>
PALPATION_INLINE void solve_panel(const Columns& l, int panel, double* x) {
  const int first = l.panel_starts[panel];
  switch (l.panel_starts[panel + 1] - first) {
    case 1:
      return solve_columns<1, kForward>(l, first, x);
    case 2:
      return solve_columns<2, kForward>(l, first, x);
    case 3:
      return solve_columns<3, kForward>(l, first, x);
    default:
      return solve_columns<kWidestPanel, kForward>(l, first, x);
  }
}

PALPATION_TARGETS void solve_strip(const Columns& l, int panel_count, double* x) {
  for (int panel = 0; panel < panel_count; ++panel) solve_panel<true>(l, panel, x);
  for (int panel = panel_count - 1; panel >= 0; --panel) solve_panel<false>(l, panel, x);
}

PALPATION_TARGETS void multiply_strip(const int* starts, const int* rows, const double* values,
                                      int n, const double* in, double* out) {
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

PALPATION_TARGETS void combine_all(double x, double* a, double y, const double* b, double z,
                                   const double* c, long count) {
  for (long i = 0; i < count; ++i) a[i] = x * a[i] + y * b[i] + z * c[i];
}

}  // namespace

std::vector<int> panels_of(const BlockFactor& factor) {
  const std::vector<int>& starts = factor.column_starts;
  const int n = static_cast<int>(starts.size()) - 1;
  // A column's rows but the first are all in the column of that first one (the elimination tree),
  // which has no others if it has no more.
  const auto goes_on = [&](int column) {
    const int count = starts[column + 1] - starts[column];
    return count > 0 && factor.rows[starts[column]] == column + 1 &&
           starts[column + 2] - starts[column + 1] == count - 1;
  };
  std::vector<int> panel_starts;
  for (int column = 0; column < n;) {
    panel_starts.push_back(column);
    const int end = std::min(column + kWidestPanel, n);
    do ++column;
    while (column < end && goes_on(column - 1));
  }
  panel_starts.push_back(n);
  return panel_starts;
}

void BlockFactor::solve(Strip& strip) const {
  const Columns columns{panel_starts.data(), column_starts.data(), rows.data(), values.data(),
                        inverse_diagonal.data()};
  solve_strip(columns, static_cast<int>(panel_starts.size()) - 1, strip.data());
}

void multiply(const Eigen::SparseMatrix<double>& a, const Strip& in, Strip& out) {
  out.resize(in.size());
  multiply_strip(a.outerIndexPtr(), a.innerIndexPtr(), a.valuePtr(), static_cast<int>(a.cols()),
                 in.data(), out.data());
}

void add_gram(const double* a, const double* b, long count, double* sums) {
  gram_rows(a, b, count, sums);
}

void combine(double x, Strip& a, double y, const Strip& b, double z, const Strip& c) {
  combine_all(x, a.data(), y, b.data(), z, c.data(), static_cast<long>(a.size()));
}

}  // namespace palpation
