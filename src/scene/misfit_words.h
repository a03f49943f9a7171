/// What of the readings the outline does not explain, where they scatter more, and whether its
/// sampling came to an end, in words.
#pragma once

#include <string>
#include <vector>

#include "scene/episode.h"

namespace palpation::tool {

/// A sentence each, the strongest first; none where no edge is known.
std::vector<std::string> misfit_words(const Conclusion& conclusion);

}  // namespace palpation::tool
