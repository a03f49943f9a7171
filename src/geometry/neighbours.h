/// Which points of space are nearest to each other.
#pragma once

#include <vector>

#include "palpation/base/types.h"

namespace palpation {

/// For every point its `count` nearest others, the nearest first; fewer where there are not so
/// many.
std::vector<std::vector<int>> nearest_others(const Points& points, int count);

}  // namespace palpation
