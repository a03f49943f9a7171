#include "certainty/band_width.h"

#include "boundary/outline_length.h"
#include "palpation/boundary/level_set.h"

namespace palpation {

double boundary_length(const Surface& surface, const Field& score) {
  return outline_length(surface, level_loops(surface, score, 0.0));
}

double mean_half_width(const Surface& surface, const Field& score, double band_score) {
  const double length = boundary_length(surface, score);
  if (length == 0.0) return 0.0;
  const double area =
      superlevel_area(surface, score, -band_score) - superlevel_area(surface, score, band_score);
  return 0.5 * area / length;
}

}  // namespace palpation
