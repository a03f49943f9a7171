/// A field's values seen from a level. Private to this folder.
#pragma once

#include <string>

#include "palpation/geometry/surface.h"

namespace palpation {

/// Throws InvalidInput unless the field has one finite value a vertex and the level is finite.
void require_field(const Surface& surface, const Field& field, double level,
                   const std::string& function);

/// The values at a face's corners less the level, each on the right side of 0, times a factor that
/// keeps them finite.
Vec3 above_level(const Surface& surface, const Field& field, double level, int face);

}  // namespace palpation
