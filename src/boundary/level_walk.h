/// From the pieces of a level line in single triangles to closed walks around the inside. Private
/// to this folder.
#pragma once

#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// Where a walk passes, by name and not by coordinates: inside the mesh edge between two vertices
/// (the level crosses an edge at one place only), or at a vertex, which is then named twice.
struct Place {
  int low;
  int high;
  auto operator<=>(const Place&) const = default;
  bool at_vertex() const { return low == high; }
};

struct Step {
  SurfacePoint point;
  Place place;
  bool on_border;  ///< of the piece that follows
};

using ClosedWalk = std::vector<Step>;

/// Along the level line, and along the border from where one line leaves the tissue to where the
/// next one enters: everywhere with the inside (field >= level) on the left. Borders that are
/// inside all along are walks of their own.
std::vector<ClosedWalk> walks_around(const Surface& surface, const Field& field, double level);

}  // namespace palpation
