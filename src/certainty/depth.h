/// How deep places lie inside a boundary. Private to this folder.
#pragma once

#include <span>
#include <vector>

#include "certainty/layout.h"
#include "palpation/boundary/level_set.h"

namespace palpation {

/// Distance of each place of the layout from the loops' pieces along the level, in a straight line,
/// unsigned; pieces along the tissue's border do not count. Empty if there are no others.
std::vector<double> distances_from(const Layout& layout, std::span<const LevelLoop> loops,
                                   std::span<const Vec3> places);

}  // namespace palpation
