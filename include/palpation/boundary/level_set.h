/// Where a field on a surface reaches a level. The rule is half open: a vertex is inside when its
/// value is at least the level.
///
/// The lines come from VTK's contour filter, fed only the triangles that the level crosses; they
/// are joined into loops by the mesh edges they share, and closed along the border of the tissue,
/// so that every loop bounds the inside, which lies on its left seen from outside. No loop visits a
/// place twice: where pieces of the inside only touch, at a vertex exactly at the level, loops are
/// cut apart. What encloses nothing (a peak or a ridge that only just reaches the level) makes no
/// loop.
#pragma once

#include <vector>

#include "palpation/boundary/region.h"
#include "palpation/geometry/surface.h"

namespace palpation {

/// A closed line on the surface, its first point not repeated. Consecutive points share a face.
/// `on_border[i]` tells that the piece from point i to point i + 1 runs along the border of the
/// tissue, not along the level.
struct LevelLoop {
  std::vector<SurfacePoint> points;
  std::vector<bool> on_border;
};

/// All loops of { field >= level }: by falling length, then by the first point's face. Empty if no
/// vertex is inside; the borders themselves if all are (so none on a closed surface). Throws
/// InvalidInput unless field has one finite value a vertex and level is finite.
std::vector<LevelLoop> level_loops(const Surface& surface, const Field& field, double level);

/// The part of the tissue where field >= level, as a region of the surface's chart. Throws as
/// level_loops, and as Surface::chart; and NumericalError, with the loops as WKT, should the
/// region's area differ from the sum over the triangles by more than rounding.
Region superlevel_region(const Surface& surface, const Field& field, double level);

/// Its area on the tissue, m2, summed over the triangles without polygons: the slow path's twin,
/// and right on any surface.
double superlevel_area(const Surface& surface, const Field& field, double level);

/// The area on the tissue, m2, of a region of the surface's chart: on flat tissue the region's own;
/// else, face by face, the share that the region covers, so that what lies beside the chart counts
/// for nothing. Throws as Surface::chart.
double surface_area(const Surface& surface, const Region& region);

}  // namespace palpation
