/// How unlike two words are.
#pragma once

#include <string>

namespace palpation::tool {

/// The fewest letters that are put in, left out or changed (Levenshtein 1966).
int edit_distance(const std::string& a, const std::string& b);

}  // namespace palpation::tool
