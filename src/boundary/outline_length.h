/// How long the outline of { field >= level } is; where it only follows the tissue's border it is
/// none.
#pragma once

#include <vector>

#include "palpation/boundary/level_set.h"

namespace palpation {

/// Metres from the loop's point i to the next, straight; 0 along the tissue's border.
double piece_length(const Surface& surface, const LevelLoop& loop, std::size_t i);

/// Metres in all.
double outline_length(const Surface& surface, const std::vector<LevelLoop>& loops);

}  // namespace palpation
