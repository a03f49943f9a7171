/// A mesh that is written to a name that a person gave.
#pragma once

#include <filesystem>

#include "palpation/geometry/triangle_mesh.h"
#include "palpation/io/coordinates.h"
#include "scene/single_file.h"

namespace palpation::tool {

/// Refuses as refuse_to_replace does, but the same mesh again is no loss. height_sd is of a PLY, or
/// empty. Throws as write_mesh.
void write_mesh_file(const std::filesystem::path& path, const TriangleMesh& mesh, LengthUnit unit,
                     const Field& height_sd, Existing existing);

}  // namespace palpation::tool
