/// What beliefs share: consecutive rows of the factor L and of V = L^-1 K(sites, vertices), and sums over all rows at each vertex. Written
/// once, then never changed.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "belief/aligned.h"
#include "palpation/base/tile.h"
#include "palpation/belief/belief.h"

namespace palpation {

struct Belief::Rows {
  int first = 0;
  int count = 0;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> factor;  // count x (first + count), lower triangular at its end
  AlignedDoubles v;                                                               // for each tile, count rows of kLanes

  long per_tile() const { return static_cast<long>(count) * kLanes; }
  const double* tile(int number) const { return v.get() + number * per_tile(); }
  double* tile(int number) { return v.get() + number * per_tile(); }
  double value(int row, int place) const { return tile(place / kLanes)[row * kLanes + place % kLanes]; }
  TileRows strip() const { return {v.get(), per_tile(), count}; }
};

/// At each vertex, over all rows: for each tile `width` rows of kLanes.
struct Belief::Sums {
  enum Row { kExplained = 0, kOnes = 1, kWhitened = 2, kTilts = 3 };

  Sums(int tile_count, int row_count)
      : width(row_count), values(aligned_doubles(static_cast<std::size_t>(tile_count) * row_count * kLanes)) {}

  int width;              // the rows above, three tilts if the prior has a slope, and last |k|^2: squared correlations with the sites
  AlignedDoubles values;  // explained: sum V^2, ones: V' L^-1 1, whitened: V' L^-1 (y - origin), tilts: V' L^-1 of Prior::tilt

  int covered() const { return width - 1; }
  const double* tile(int number) const { return values.get() + static_cast<long>(number) * width * kLanes; }
  double* tile(int number) { return values.get() + static_cast<long>(number) * width * kLanes; }
  double at(int place, int row) const { return tile(place / kLanes)[row * kLanes + place % kLanes]; }
};

}  // namespace palpation
