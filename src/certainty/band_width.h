/// How long a boundary that is told by a score is, and how wide its band.
#pragma once

#include "palpation/geometry/surface.h"

namespace palpation {

/// Of the score's level set at 0, metres; where it only follows the tissue's border it is none.
double boundary_length(const Surface& surface, const Field& score);

/// Area between the score's level sets at -band_score and band_score, over twice that length;
/// metres, 0 where there is no boundary.
double mean_half_width(const Surface& surface, const Field& score, double band_score);

}  // namespace palpation
