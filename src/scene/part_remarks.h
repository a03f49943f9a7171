/// What is said of parts: that they may be none, were felt once, reach the border of the tissue, or
/// have holes.
#pragma once

#include <string>
#include <vector>

#include "palpation/exploration/conclusion.h"
#include "scene/parts.h"

namespace palpation::tool {

/// A sentence each.
std::vector<std::string> part_remarks(const std::vector<TumourPart>& parts,
                                      const Conclusion& conclusion);

}  // namespace palpation::tool
