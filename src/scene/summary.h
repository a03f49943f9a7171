/// summary.json: what was found, how sure that is, and by which options.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "palpation/boundary/region_error.h"
#include "scene/episode.h"

namespace palpation::tool {

/// `warnings` are those of what was given; what is odd about the result is added.
nlohmann::json summary_of(const Episode& episode, const Scene& scene,
                          std::vector<std::string> warnings);

/// Of two boundaries that were compared.
nlohmann::json comparison_of(const RegionError& error, const Scene& scene, const Surface& surface,
                             const std::vector<std::string>& warnings);

}  // namespace palpation::tool
