/// Cholesky's factor by the loops of tile.h.
#pragma once

namespace palpation {

/// Replaces the lower triangle of a symmetric matrix (row-major, rows `stride` apart) by its factor
/// L, eight rows at a time. What is above the diagonal is neither read nor changed. Returns `size`,
/// or the first row whose pivot is not positive and finite: its diagonal then has that pivot, and
/// of the rows after it nothing is known.
long factorize(double* lower, long stride, long size);

}  // namespace palpation
