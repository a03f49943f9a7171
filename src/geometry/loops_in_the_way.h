/// Why a surface that is no disk cannot be laid flat, in words.
#pragma once

#include <string>
#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// Counts components, handles and border loops, and says where the loops but the longest are: the
/// holes, as one takes them.
std::string loops_in_the_way(const Topology& topology,
                             const std::vector<std::vector<int>>& border_loops,
                             const Points& vertices);

}  // namespace palpation
