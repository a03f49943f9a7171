/// Tissue that hides a part of itself from every viewer, drawn in its chart.
#pragma once

#include "draw/outcome.h"

namespace palpation::draw {

/// The outcome with everything moved to the plane of the tissue's chart (point arrays chart_u and
/// chart_v, metres), where the tissue is folded: where more than a part of its area looks away from
/// the side that most of it looks to. Else, and without a chart, the outcome as it is.
Outcome unrolled_where_folded(Outcome outcome);

}  // namespace palpation::draw
