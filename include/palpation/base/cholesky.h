/// Cholesky's factor by the loops of tile.h.
#pragma once

namespace palpation {

/// Replaces the lower triangle of a symmetric matrix (row-major, rows `stride` apart) by its factor L, eight rows at a time. Returns
/// `size`, or the first row whose pivot is not positive and finite: there the pivot stands, and what follows is undone work. What is above
/// the diagonal is not read, and means nothing afterwards.
long factorize(double* lower, long stride, long size);

}  // namespace palpation
