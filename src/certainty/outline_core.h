/// A tumour of two heights: a core, and around it or beside it tissue that stands out by less.
///
/// An outline of one height goes halfway up. Where a part of the tumour reaches no farther than
/// about there, its readings lie on the edge wherever they were made, and the outline becomes
/// fingers that follow them. With a core, a stadium, the contrast beyond it is a share of the
/// core's; the outline goes halfway up to either. Of the core's border only what lies within the
/// outline is felt: beyond, what it adds ends with the outline.
#pragma once

#include <cmath>

#include "certainty/stadium.h"

namespace palpation {

/// What stands out beside a core by less of its contrast is said, but not cut out: where the
/// boundary is half way up, as of parts (own_parts.h), and as much more as it lies higher.
double least_beside(double fraction);

struct OutlineCore {
  int part = 0;  ///< of the outline, which it belongs to: no other knows of it
  Vec2 middle = Vec2::Zero();
  double log_radius = 0.0;  ///< of metres
  double half_length_m = 0.0;
  double angle = 0.0;
  double beside = 1.0;  ///< contrast beyond it, of the core's

  Stadium stadium() const {
    return stadium_about(middle, std::exp(log_radius), half_length_m, angle);
  }
};

/// Of one in a tumour that is about there and as wide as that, whose boundary is at that fraction
/// of the way up, in whatever direction; -infinity where it may not be. Of middle and half length
/// in metres, the radius' logarithm and the contrast beside it.
double log_core_density(const OutlineCore& core, const Vec2& tumour_middle, double tumour_radius_m,
                        double fraction);

}  // namespace palpation
