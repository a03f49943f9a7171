/// Readings that a probe makes while it slides: many, close together, each telling little.
#pragma once

#include <span>
#include <vector>

#include "palpation/geometry/surface.h"
#include "palpation/readings/palpation.h"

namespace palpation {

/// Those without a direction of travel, as if the probe had come straight from where it was before,
/// in the same session.
std::vector<Palpation> with_travel(const Surface& surface, std::vector<Palpation> palpations);

/// Whether most readings lie nearer to the one before than anything is felt.
bool follow_closely(const Surface& surface, std::span<const Palpation> palpations);

/// Readings on the way that follow each other in one direction within `within_m`, and differ from
/// the first of them by no more than noise does, as one, in their middle, with their precisions
/// added up. Where they differ by more there is an edge, over which a mean is not what lies in the
/// middle; what noise alone makes them differ by tells nothing of their mean. So nothing is lost
/// but their number, whose third power all else costs. A noise of zero is not for averaging: then
/// nothing changes. `noise_variance`: of readings whose own is not given.
std::vector<Palpation> merged_on_the_way(const Surface& surface,
                                         std::span<const Palpation> palpations, double within_m,
                                         double noise_variance);

}  // namespace palpation
