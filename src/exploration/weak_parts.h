/// What stands out by less than a tumour does.
#pragma once

#include "palpation/exploration/conclusion.h"

namespace palpation {

/// Takes the parts out of a conclusion whose contrast is surely below the model's least one: their
/// highest place, and 1.645 standard deviations more, lies no farther above the mean of the healthy
/// tissue. They stay in `weaker`; where nothing else is left, there is no level and no boundary, as
/// if no contrast were seen.
void take_out_weak_parts(Conclusion& conclusion);

}  // namespace palpation
