/// The tissue that a scene names.
#pragma once

#include <string>
#include <vector>

#include "palpation/geometry/surface.h"
#include "palpation/io/coordinates.h"
#include "scene/scene.h"

namespace palpation::tool {

struct Tissue {
  Surface surface;
  std::vector<std::string> warnings;  ///< of the reader
  Frame frame = Frame::Mesh;          ///< as scene or mesh file say; they must agree
};

/// Reads, cuts and refines the scene's mesh. Throws IoError, InvalidMesh, and InvalidInput that
/// says what to do where the scene asks for what the mesh cannot give.
Tissue tissue_of(const Scene& scene);

}  // namespace palpation::tool
