/// The first lines of an outline: where a field crosses zero, as nodes in the chart's plane.
#pragma once

#include <vector>

#include "certainty/outline_nodes.h"
#include "palpation/geometry/surface.h"

namespace palpation {

/// Pieces: a probe's tip is some millimetres wide, and nothing finer is felt.
inline constexpr double kSpacing_m = 0.001;

/// The largest first.
std::vector<std::vector<Vec2>> lines_of(const Surface& surface, const Field& depth);

/// Of lines that enclose a reading, and the largest of all: of the others nothing is known. Holes
/// belong to the part that they lie in. The smallest go until no lines cross: nothing where those
/// of one do.
OutlineNodes outline_from(const std::vector<std::vector<Vec2>>& lines,
                          const std::vector<Vec2>& readings);

/// The nodes of one of its loops.
std::vector<Vec2> line_of(const OutlineNodes& outline, const NodeLoop& loop);
/// By all loops: holes run clockwise.
double enclosed_area(const OutlineNodes& outline);

}  // namespace palpation
