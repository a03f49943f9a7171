/// What was run, in sixteen digits: rows of different scenes, tissues or programs must not be added
/// up.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "palpation/geometry/triangle_mesh.h"

namespace palpation::tool {

/// FNV-1a of the bytes, 64 bits, in hexadecimal digits. Tells what differs by accident; no
/// protection against those who want it to be the same.
std::string digest(std::string_view bytes);
/// Of coordinates and triangles, to the last bit.
std::string digest(const TriangleMesh& mesh);
/// Of keys and values, whatever the order in which they were written.
std::string json_digest(const nlohmann::json& value);
/// Of the file that this process runs.
std::string program_digest();

}  // namespace palpation::tool
