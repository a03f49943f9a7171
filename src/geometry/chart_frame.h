/// Where a chart of curved tissue has its origin, and which way its axes run.
#pragma once

#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

/// The flattened mesh moved and turned into the frame of chart.h.
Points2 in_frame(const TriangleMesh& mesh, const Points2& uv);

}  // namespace palpation
