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

/// What `palpate info` would say of it that a person should know before a run: the warnings, and
/// what is odd about the surface (surface_remarks.h). A sentence or two each.
std::vector<std::string> start_remarks(const Tissue& tissue);

}  // namespace palpation::tool
