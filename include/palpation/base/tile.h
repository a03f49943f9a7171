/// The innermost loops over the vertices, of the posterior and of a surface's waves: rows of values over tiles of eight vertices, one cache
/// line a row.
#pragma once

namespace palpation {

inline constexpr int kLanes = 8;

/// fresh[r] -= sum_i factor[r * stride + i] * tile[i], for `rows` rows of kLanes values each, i < depth.
void subtract_product(const double* factor, int stride, const double* tile, int depth, double* fresh, int rows);

/// Solves T fresh = fresh in place, T the lower triangle factor[r * stride + i], i <= r < rows.
void solve_triangle(const double* factor, int stride, double* fresh, int rows);

}  // namespace palpation
