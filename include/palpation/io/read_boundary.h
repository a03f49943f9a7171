/// Boundaries from files that this project wrote.
#pragma once

#include <filesystem>

#include "palpation/geometry/surface.h"
#include "palpation/io/boundary_file.h"

namespace palpation {

/// The region that the loops of kind "estimate" of a boundary.vtp bound (all loops, if the file does not tell kinds), in the surface's
/// chart. Each point goes to the closest point of the surface. Throws IoError, naming the point where one lies farther than 5 mm from the
/// surface.
BoundaryFile read_boundary_vtp(const std::filesystem::path& path, const Surface& surface);

}  // namespace palpation
