/// How readings within a disk add up to finding it. Private to this folder.
#pragma once

#include <cstddef>
#include <string>

#include "certainty/detection.h"

namespace palpation {

/// Throws InvalidInput in a function's name unless contrast and slope are positive and the
/// probability lies in (0, 1).
void check(const Sought& sought, const std::string& function);

/// Of a disk, so deep in it; 0 outside.
double rise_in_disk(double depth_m, double slope_per_m);

/// What the squared rises of the readings in a disk must come to, so that it is found among as many
/// readings; 0 where they have no noise, and one is enough.
double needed_rises(std::size_t readings, const Sought& sought);

}  // namespace palpation
