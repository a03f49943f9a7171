/// Rings as well-known text, for the message of an error that should never have happened: what to
/// try again with. Private to this folder.
///
/// Doubles keep all their digits. The text stays below some 20,000 characters and is well-known
/// text up to its closing bracket: what does not fit is left out whole, and the words behind the
/// bracket say how much that is.
#pragma once

#include <span>
#include <string>

#include "palpation/boundary/region.h"

namespace palpation {

/// As MULTIPOLYGON, which is how boundaries are read from files.
std::string well_known_text(std::span<const PolygonWithHoles> polygons);

/// As MULTILINESTRING of closed lines: rings that may cross.
std::string well_known_text(std::span<const Ring> rings);

}  // namespace palpation
