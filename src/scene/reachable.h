/// How well a boundary could be known at best.
#pragma once

#include <optional>

#include "scene/episode.h"

namespace palpation::tool {

/// How many times as wrong the boundary is expected to be as one of that length by that many
/// readings can be (reference_bound.h); nothing where its edge is not known, or has no noise.
std::optional<double> over_reachable(const Episode& episode);

}  // namespace palpation::tool
