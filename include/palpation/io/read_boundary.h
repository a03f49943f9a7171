/// Boundaries from VTP files: this project's own, and outlines as other programs write them.
#pragma once

#include <filesystem>

#include "palpation/geometry/surface.h"
#include "palpation/io/boundary_file.h"

namespace palpation {

/// The region that the loops of kind "estimate" of a boundary.vtp bound (all loops, if the file
/// does not tell kinds), in the surface's chart. Lines may come in pieces, which join where they
/// end in the same place; lengths are metres unless its field data say another UNIT; a file with
/// lines of other kinds only is a boundary around nothing, with a warning. Each point goes to the
/// closest point of the surface. Throws IoError for a line that ends where no other goes on, lines
/// around no area, and a point farther than 5 mm from the surface.
BoundaryFile read_boundary_vtp(const std::filesystem::path& path, const Surface& surface);

}  // namespace palpation
