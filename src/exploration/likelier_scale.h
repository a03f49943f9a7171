/// Whether readings are told better by their logarithms.
#pragma once

#include <vector>

#include "palpation/exploration/conclusion.h"

namespace palpation {

/// Logarithms, where an edge between two plateaus, with noise about it that is alike on both, makes
/// the readings more probable by them than as they are, by more than chance (misfit.h): a field's
/// own evidence would prefer logarithms of any plateaus. As they are where a reading is not
/// positive, no edge is found on both scales, or other readings count on one than on the other.
/// What was tried on either is remembered.
ReadingScale likelier_scale(const Surface& surface, const Model& model,
                            const std::vector<Palpation>& felt, ConclusionCache& cache);

}  // namespace palpation
