/// What is said of parts: that they may be none, were felt once, reach the border of the tissue, or
/// have holes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "palpation/geometry/surface.h"
#include "palpation/readings/palpation.h"
#include "scene/parts.h"

namespace palpation::tool {

/// A sentence each.
std::vector<std::string> part_remarks(const std::vector<TumourPart>& parts, const Surface& surface,
                                      std::span<const Palpation> palpations);

}  // namespace palpation::tool
