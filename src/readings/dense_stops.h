/// Stops that are denser than anything is felt.
#pragma once

#include <span>
#include <vector>

#include "palpation/geometry/surface.h"
#include "palpation/readings/palpation.h"

namespace palpation {

/// Stops of one batch and session within a cube of `within_m`, and that differ from the least of
/// them by no more than noise does, as one, in their middle: as merged_on_the_way has it, in
/// whatever order they were made. Each knows its number in the list that is given.
std::vector<Palpation> merged_in_cells(const Surface& surface,
                                       std::span<const Palpation> palpations, double within_m,
                                       double noise_variance);

}  // namespace palpation
