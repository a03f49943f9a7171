/// Many right-hand sides at once: strips of sixteen vectors, value by value side by side, go
/// through a sparse factor together.
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

namespace palpation {

inline constexpr int kStrip = 16;

/// n rows of kStrip values.
using Strip = std::vector<double>;

/// A symmetric positive definite matrix A = P' L D L' P (unit lower L) with the ordering's vectors:
/// everything below is in that order.
struct BlockFactor {
  std::vector<int> column_starts, rows;  // of L below its diagonal, by columns
  std::vector<double> values;
  std::vector<double> inverse_diagonal;
  std::vector<int> panel_starts;  // first columns of panels_of(*this), and n

  /// Solves L D L' x = b in place.
  void solve(Strip& strip) const;
};

/// Neighbouring columns, four at most, that have the same rows below the last of them: a solve then
/// meets each of those rows once for all. Such are most of the columns where a factor has filled
/// in.
std::vector<int> panels_of(const BlockFactor& factor);

/// out = A in, A symmetric and compressed.
void multiply(const Eigen::SparseMatrix<double>& a, const Strip& in, Strip& out);

/// 16 x 16 products a' b over `count` rows of two strips, row by row, added to `sums` in the order
/// of the rows.
void add_gram(const double* a, const double* b, long count, double* sums);

/// a = x a + y b + z c.
void combine(double x, Strip& a, double y, const Strip& b, double z, const Strip& c);

}  // namespace palpation
