/// Where to touch before anything is known. Every design returns distinct vertices of the
/// candidates in increasing order; the tour is left to the caller.
#pragma once

#include <span>
#include <vector>

#include "palpation/base/random.h"
#include "palpation/geometry/surface.h"

namespace palpation {

enum class Design {
  Random,  ///< uniform over the tissue's area
  Grid,    ///< nearest vertices to the centres of a grid's cells over the tissue's extent in its
           ///< chart; cells as square as count allows
  LowDiscrepancy  ///< nearest vertices to a randomly shifted R2 sequence (Roberts 2018) in the
                  ///< chart
};

/// `count` distinct vertices, or all candidates if there are fewer. Grid and LowDiscrepancy need a
/// chart; on tissue that does not fill its chart's bounding box more points are drawn until enough
/// lie on it, and a place whose nearest candidate is taken gets the next nearest. A grid whose
/// count allows no cells at most twice as long as wide is taken from the next larger one, some of
/// its cells left out at even intervals. Throws InvalidInput if count is negative or a candidate is
/// no vertex, and as Surface::chart; NumericalError if the tissue fills less than about a
/// ten-thousandth of its chart's bounding box.
std::vector<int> initial_design(const Surface& surface, Design design, int count,
                                std::span<const int> candidates, Random& random);

}  // namespace palpation
