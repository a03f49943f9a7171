/// The area on the tissue of what is drawn in its chart. Private to this folder.
#pragma once

#include "palpation/boundary/region.h"
#include "palpation/geometry/surface.h"

namespace palpation {

/// m2: of every face of the tissue, the share of its triangle in the chart that the region covers,
/// times the area on the tissue. What lies beside the chart does not count. Exact but for rounding,
/// wherever rings run: along edges of the mesh, through its vertices.
double tissue_area(const Surface& surface, const Region& region);

}  // namespace palpation
