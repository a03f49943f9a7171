/// Consecutive rows of the factor L and of V = L^-1 K(sites, vertices). Written once, then shared between beliefs.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "palpation/base/tile.h"
#include "palpation/belief/belief.h"

namespace palpation {

struct Belief::Rows {
  int first = 0;
  int count = 0;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> factor;  // count x (first + count), lower triangular at its end
  std::unique_ptr<double[]> v;                                                    // for each tile, count rows of kLanes

  const double* tile(int number) const { return v.get() + static_cast<long>(number) * count * kLanes; }
  double* tile(int number) { return v.get() + static_cast<long>(number) * count * kLanes; }
  double value(int row, int vertex) const { return tile(vertex / kLanes)[row * kLanes + vertex % kLanes]; }
};

}  // namespace palpation
