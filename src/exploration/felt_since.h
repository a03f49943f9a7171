/// What tells where tissue lies since it changed.
#pragma once

#include <span>

#include "palpation/certainty/misfit.h"
#include "palpation/geometry/surface.h"
#include "palpation/readings/palpation.h"

namespace palpation {

/// Whether those before it and those since feel an edge: of healthy tissue alone nothing tells
/// where it lies.
bool is_felt_on_both_sides(const Misfit& change, double level, std::span<const Palpation> readings);

/// Whether much of the ground was felt both before and since: a raster's rows are of another
/// part of a tumour, which may look like the first, laid elsewhere.
bool is_felt_again(const Misfit& change, const Surface& surface,
                   std::span<const Palpation> readings);

}  // namespace palpation
