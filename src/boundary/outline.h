/// Polygons as a person or another program gives them, made into clean ones or refused. Private to
/// this folder.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "boundary/exact_polygons.h"
#include "palpation/boundary/region.h"

namespace palpation {

/// The corners of a ring as they are. Throws InvalidInput, naming the ring and the corner, if a
/// coordinate is not finite or beyond 1e9 m, or if all are so near to the origin that the ring's
/// area is no number.
ExactRing exact_ring(const Ring& ring, const std::string& function, const std::string& name);

/// " of polygon 3", or nothing where there is only one.
std::string which_polygon(std::size_t number, std::size_t count);

/// What the polygon encloses, whichever way its rings run. Pinched rings are cut at the pinch; what
/// has no area is left out. Throws what Region's constructor says; `which` follows the names of
/// rings.
std::vector<ExactPolygon> enclosed_by(const PolygonWithHoles& polygon, const std::string& which,
                                      const std::string& function);

/// What is tidied away of a ring before it is looked at.
struct Untidy {
  int repeats = 0;           ///< corners where the ring already was
  int spikes = 0;            ///< tips of spikes of no width
  bool has_no_area = false;  ///< nothing is left: then what else was wrong with it is not counted
};
Untidy untidy_parts(const Ring& ring, const std::string& function, const std::string& name);

}  // namespace palpation
