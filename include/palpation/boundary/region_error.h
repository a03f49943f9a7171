/// How wrong an estimated region is.
#pragma once

#include <optional>

#include "palpation/boundary/region.h"
#include "palpation/geometry/surface.h"

namespace palpation {

struct RegionError {
  double missed_m2 =
      0.0;  ///< tumour left behind: truth without estimate (the paper's positive margin)
  double extra_m2 =
      0.0;  ///< healthy tissue taken: estimate without truth (the paper's negative margin)
  double symmetric_difference_m2 = 0.0;  ///< their sum
  double dice = 1.0;                     ///< 2 |A & B| / (|A| + |B|); 1 if both are empty
  std::optional<double> hausdorff_m;  ///< greatest distance from a point of either boundary to the
                                      ///< other; none if a region is empty
  std::optional<double>
      mean_distance_m;  ///< the same, averaged along both boundaries; none if a region is empty
};

/// Areas on the tissue, exact for the mesh; distances along straight lines of the chart, measured
/// on the tissue where the chart stretches it: to the place that is nearest by the stretch at the
/// other end. Boundaries are sampled no coarser than a 4000th of their length for the distances,
/// and at every corner. On curved tissue what lies beside the chart has no area. Throws as
/// Surface::chart.
RegionError compare(const Surface& surface, const Region& estimate, const Region& truth);

/// The part of a surface where field >= level, with or without a chart.
struct Superlevel {
  Field field;
  double level = 0.0;
};

/// The same on any surface: closed, with handles, of several components. Areas face by face, where
/// both parts are convex polygons: exact for the mesh. Distances are left out: they need a chart.
/// Throws InvalidInput unless fields have one finite value a vertex and levels are finite.
RegionError compare(const Surface& surface, const Superlevel& estimate, const Superlevel& truth);

}  // namespace palpation
