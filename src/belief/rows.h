/// What beliefs share: consecutive rows of the factor L and of V = L^-1 K(sites, vertices), and
/// sums over all rows at each vertex. Written once, then never changed.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <vector>

#include "base/tile.h"
#include "belief/aligned.h"

namespace palpation {

struct FactorRows {
  int first = 0;
  int count = 0;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>
      factor;              // count x (first + count), lower triangular at its end
  AlignedDoubles v;        // for each tile, count rows of kLanes, or
  Aligned<float> singles;  // the same in single precision

  long per_tile() const { return static_cast<long>(count) * kLanes; }
  double* tile(int number) { return v.get() + number * per_tile(); }
  /// The tile's rows; in single precision they are widened into `scratch`, which has room for them.
  const double* tile(int number, double* scratch) const {
    if (!singles) return v.get() + number * per_tile();
    std::copy_n(singles.get() + number * per_tile(), per_tile(), scratch);
    return scratch;
  }
  double value(int row, int place) const {
    const long at = place / kLanes * per_tile() + row * kLanes + place % kLanes;
    return singles ? static_cast<double>(singles[at]) : v[at];
  }
  TileRows strip() const { return {v.get(), per_tile(), count, singles.get()}; }
};

/// At each vertex, over all rows: for each tile `width` rows of kLanes.
struct VertexSums {
  enum Row { kExplained = 0, kOnes = 1, kReadings = 2, kTilts = 3 };

  VertexSums(int tile_count, bool has_slope)
      : width(has_slope ? kTilts + 4 : kTilts + 1),
        values(aligned_doubles(static_cast<std::size_t>(tile_count) * width * kLanes)) {}

  int width;  // the rows above, three tilts if the prior has a slope, and last |k|^2: squared
              // correlations with the sites
  AlignedDoubles values;  // explained: sum V^2, ones: V' L^-1 1, readings: V' L^-1 (y - origin),
                          // tilts: V' L^-1 of Prior::tilt

  int covered() const { return width - 1; }
  const double* tile(int number) const {
    return values.get() + static_cast<long>(number) * width * kLanes;
  }
  double* tile(int number) { return values.get() + static_cast<long>(number) * width * kLanes; }
  double at(int place, int row) const {
    return tile(place / kLanes)[row * kLanes + place % kLanes];
  }
};

}  // namespace palpation
