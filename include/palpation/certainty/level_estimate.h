/// Where the level lies when nobody says so.
#pragma once

#include "palpation/belief/belief.h"
#include "palpation/belief/level.h"

namespace palpation {

/// h = min + fraction (max - min) of the mean at the vertices: the paper's level (section V.3),
/// with the "min +" that its formula leaves out and its own figures need. Without a standard
/// deviation. Throws InvalidInput unless fraction lies in (0, 1) and there is a vertex.
Level level_from_range(const Marginals& marginals, double fraction);

}  // namespace palpation
