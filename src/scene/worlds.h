/// The worlds that answer a scene's touches.
#pragma once

#include <filesystem>
#include <vector>

#include "scene/episode.h"

namespace palpation::tool {

/// The scene's phantom. The probe's noise has a stream of its own, so that it does not change with
/// the plan.
World simulated_world(const Scene& scene, const Surface& surface);

/// Dense recordings. Their truth is the map of the first one, at the level's fraction between its
/// 2nd and 98th percentile; a vertex is touched once.
World recorded_world(const Scene& scene, const Surface& surface,
                     const std::vector<std::filesystem::path>& paths);

}  // namespace palpation::tool
