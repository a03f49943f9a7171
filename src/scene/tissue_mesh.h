/// The mesh that a scene names, before anything is cut out of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpation/geometry/triangle_mesh.h"
#include "palpation/io/coordinates.h"
#include "scene/scene.h"

namespace palpation::tool {

struct MeshOfScene {
  TriangleMesh mesh;
  Frame frame = Frame::Mesh;  ///< as surface.frame or the file itself says
};

/// Reads surface.mesh, or makes surface.plane. Adds the reader's warnings. Throws IoError, also
/// where the scene and the file say that coordinates are in different frames.
MeshOfScene mesh_of(const Scene& scene, std::vector<std::string>& warnings);

/// Relative to the scene; a path that leads nowhere from there, as one given by --set may, is
/// relative to where the tool runs.
std::filesystem::path mesh_path(const Scene& scene);

}  // namespace palpation::tool
