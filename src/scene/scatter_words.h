/// How readings scatter about an edge, in words.
#pragma once

#include <string>

#include "palpation/exploration/conclusion.h"

namespace palpation::tool {

/// On which scale evenly; nothing where readings are taken as they are, or as the scene says.
std::string scale_words(const Conclusion& conclusion);
/// How much more on a tumour, by outlines; nothing unless it surely is more.
std::string more_scatter_words(const Conclusion& conclusion);

}  // namespace palpation::tool
