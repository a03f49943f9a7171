/// Boundaries from files that this project wrote.
#pragma once

#include <filesystem>

#include "palpation/boundary/region.h"
#include "palpation/geometry/surface.h"

namespace palpation {

/// The region that the loops of kind "estimate" of a boundary.vtp bound (all loops, if the file does not tell kinds), in the surface's
/// chart. Throws IoError, and InvalidInput where a point lies farther than 5 mm from the surface.
Region read_boundary_vtp(const std::filesystem::path& path, const Surface& surface);

}  // namespace palpation
