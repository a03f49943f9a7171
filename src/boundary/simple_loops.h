/// Walks around the inside, cut and joined until each is a loop that visits no place twice. Private
/// to this folder.
#pragma once

#include "boundary/level_walk.h"

namespace palpation {

/// What the walks enclose together, without pieces of no length and without pieces along which two
/// walks, or one, run there and back (a ridge exactly at the level encloses nothing).
std::vector<ClosedWalk> simple_loops(const std::vector<ClosedWalk>& walks);

}  // namespace palpation
