/// The level line inside each triangle, from VTK's contour filter. Private to this folder.
#pragma once

#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// One piece of the level line: across a face, with the inside (field >= level) on its left seen
/// from outside. It enters by the edge from corner `entry` to the next one and leaves by the edge
/// from corner `exit` to the next one. Two faces name the same point of an edge by the same
/// weights.
struct LevelSegment {
  int face;
  int entry;
  int exit;
  Vec3 entry_weights;  ///< barycentric, the weight of the corner off the edge being 0
  Vec3 exit_weights;
};

/// A factor, 1 but for values near the limit of doubles, by which differences of values up to
/// `greatest` stay finite.
double safe_scale(double greatest);

/// The field's value times that factor, on the same side of the scaled level as before.
double scaled_value(double value, double level, double scale);

/// In the order of the faces. The field must be finite.
std::vector<LevelSegment> level_segments(const Surface& surface, const Field& field, double level);

}  // namespace palpation
