/// What must hold before VTK may see a VTP file: its parser believes every count, offset and block size that it is told, and reads beyond
/// its buffers.
#pragma once

#include <string>

#include "io/mesh_source.h"

namespace palpation {

/// The file with its comments blanked, once every count, offset and size of a block has been reconciled with the bytes there are. Throws
/// IoError with the byte at fault. Beyond what VTK asks, entities, CDATA and document types are refused, since VTK's parser would see
/// another text than this one.
std::string vetted_vtp(const MeshSource& source);

}  // namespace palpation
