/// How much of what was found may be wrong, and where the most of it.
#pragma once

#include <string>
#include <vector>

#include "scene/episode.h"

namespace palpation::tool {

/// A sentence each: of what counts as stiff there is too much to be a tumour, much of it may be
/// wrong, or far more than so many readings leave open. `has_parts`: something was found.
std::vector<std::string> area_remarks(const Episode& episode, bool has_parts);

}  // namespace palpation::tool
