/// How wrong an estimated region is.
#pragma once

#include <optional>

#include "palpation/boundary/region.h"
#include "palpation/geometry/surface.h"

namespace palpation {

struct RegionError {
  double missed_m2 = 0.0;                 ///< tumour left behind: truth without estimate (the paper's positive margin)
  double extra_m2 = 0.0;                  ///< healthy tissue taken: estimate without truth (the paper's negative margin)
  double symmetric_difference_m2 = 0.0;   ///< their sum
  double dice = 1.0;                      ///< 2 |A & B| / (|A| + |B|); 1 if both are empty
  std::optional<double> hausdorff_m;      ///< greatest distance from a point of either boundary to the other; none if a region is empty
  std::optional<double> mean_distance_m;  ///< the same, averaged along both boundaries; none if a region is empty
};

/// Areas on the tissue; distances in the chart (so far every chart is isometric). Boundaries are sampled no coarser than a 4000th of their
/// length for the distances, and at every corner. Throws InvalidInput where the chart is not isometric.
RegionError compare(const Surface& surface, const Region& estimate, const Region& truth);

}  // namespace palpation
