/// Where on the tissue.
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "palpation/geometry/surface.h"
#include "python/arrays.h"

namespace palpation::python {

/// Vertices (n whole numbers) or places in metres (n x 3, at most 5 mm above or below the tissue
/// and 1 mm beside its border, taken to the closest point). Throws as arrays.h says, and
/// InvalidInput for a place that is not on the tissue, naming its row.
std::vector<SurfacePoint> places_on(const Surface& surface, pybind11::handle where,
                                    const Argument& argument);

}  // namespace palpation::python
