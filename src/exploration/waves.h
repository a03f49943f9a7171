/// Healthy tissue that rises and falls slowly: backgrounds that readings may have.
#pragma once

#include <vector>

#include "certainty/edge_data.h"
#include "certainty/layout.h"

namespace palpation {

/// Slow waves (slow_waves.h), at the vertices, that two parallel surfaces on which the readings lie
/// share (parallel_surfaces.h); those that are likelier than two level surfaces by `needed` nats,
/// the likeliest first, `most` at most. It is no matter how much of the tissue either surface
/// holds. From level ones, and from how high the lower and higher readings of each neighbourhood
/// lie. Nothing for fewer than fifteen places, or where all readings are alike.
std::vector<Field> waves_of_parallel_surfaces(const Layout& layout, const EdgeData& readings,
                                              double needed, int most);

}  // namespace palpation
