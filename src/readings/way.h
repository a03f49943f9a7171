/// Readings that a probe makes while it slides: many, close together, each telling little.
#pragma once

#include <span>
#include <vector>

#include "palpation/geometry/surface.h"
#include "palpation/readings/palpation.h"

namespace palpation {

/// Readings on the way that follow each other in one direction within `within_m` as one, in their
/// middle, with their precisions added up. The field is all but linear over so short a piece, so
/// nothing is lost but their number, whose third power all else costs. A noise of zero is not for
/// averaging: then nothing changes. `noise_variance`: of readings whose own is not given.
std::vector<Palpation> merged_on_the_way(const Surface& surface,
                                         std::span<const Palpation> palpations, double within_m,
                                         double noise_variance);

}  // namespace palpation
