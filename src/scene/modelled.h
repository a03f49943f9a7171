/// What an answer takes into account, as summary.json lists it.
#pragma once

#include <string>
#include <vector>

#include "palpation/exploration/conclusion.h"

namespace palpation::tool {

/// Every term of the model that is on, because a scene asks for it or because readings show it: no
/// tumour at all, or how its level and its boundary are known; what is in the readings besides; how
/// sure that is. What is not listed changes nothing.
std::vector<std::string> modelled(const Conclusion& conclusion);

}  // namespace palpation::tool
