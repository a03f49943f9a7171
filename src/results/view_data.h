/// What the view of a report in 3-D shows, as data for its script (src/draw/report/viewer.js).
#pragma once

#include <nlohmann/json.hpp>

#include "results/run.h"

namespace palpation::results {

/// Tissue of more vertices is not shown in 3-D: the page would take a browser's memory.
inline constexpr Eigen::Index kMostVertices = 400'000;

/// Millimetres. States after each batch come with it as far as there is room: at most about 5 MB in
/// all; where there are more, evenly spaced ones.
nlohmann::json view_data(const Run& run);

/// Between which values colours run, by the names of the fields (limits.h).
nlohmann::json colour_limits(const Run& run);

}  // namespace palpation::results
