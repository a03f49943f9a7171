/// A mesh in plain words: what it is, what is wrong with it, and what to do.
#pragma once

#include <string>

#include "palpation/geometry/surface.h"
#include "palpation/geometry/triangle_mesh.h"

namespace palpation::tool {

/// "25.00 x 50.00 x 0.00 mm".
std::string size_words(const TriangleMesh& mesh);

/// Whether some stretch of a chart is more than 10 % off.
bool misleads(const Distortion& distortion);

/// "stretched to between 95.2 and 108.9 % of its length".
std::string stretch_words(const Distortion& distortion);

/// Topology, components and borders where there are several, area, edges, curvature, where it runs
/// through itself, what it supports; `next` where it can be worked on as it is, else what to do
/// first.
std::string surface_words(const Surface& surface, const std::string& next);

/// Why it is no surface: the first fault as `reason` tells it, how many there are of each kind,
/// what each means and what to do.
std::string fault_words(const TriangleMesh& mesh, const std::string& reason);

}  // namespace palpation::tool
