/// Where a point of the surface lies in its chart.
#pragma once

#include "palpation/geometry/surface.h"

namespace palpation {

/// (u, v), metres, linear inside the face. Throws as Surface::chart.
Vec2 chart_place(const Surface& surface, const SurfacePoint& point);

}  // namespace palpation
