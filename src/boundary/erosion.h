/// What a probe with a round tip feels early, taken back.
///
/// A sphere of radius r touches what is stiff with its flank when its axis is still r away: what it
/// reads at a place is, at most, what the stiffest tissue within r of it would read. The erosion of
/// the readings' field undoes that: at every place the least value within r. Its level sets lie r
/// inside those of the field, all of them alike, and what is narrower than 2 r vanishes, as it
/// should: a sphere never reads less than 2 r of it.
#pragma once

#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

struct Eroded {
  Field field;
  std::vector<int> from;  ///< the vertex nearest to where each value was found
};

/// The least value of a field, linear on every edge, within a radius of each vertex: straight
/// through space, over edges that lead there without leaving the ball. The tissue's border is no
/// edge. With radius 0 the field itself.
///
/// Laws: (1) eroded <= field; (2) { eroded >= h } contains a vertex only if { field >= h } contains
/// all vertices that the ball reaches; (3) the more the radius, the less the value. Throws
/// InvalidInput unless the radius is finite and not negative.
Eroded eroded(const Surface& surface, const Field& field, double radius_m);

}  // namespace palpation
