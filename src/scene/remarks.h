/// What a person should know before trusting a boundary.
#pragma once

#include <string>
#include <vector>

#include "scene/episode.h"

namespace palpation::tool {

/// A sentence each.
std::vector<std::string> boundary_remarks(const Episode& episode);

}  // namespace palpation::tool
