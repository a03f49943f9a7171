/// The way of the probe from touch to touch.
#pragma once

#include <nlohmann/json.hpp>

#include "results/pack.h"
#include "results/run.h"

namespace palpation::results {

/// By batch, both ends of each piece of the way: along path.csv where that tells it, else straight.
nlohmann::json tours_of(const Run& run, const PlaceGrid& grid);

}  // namespace palpation::results
