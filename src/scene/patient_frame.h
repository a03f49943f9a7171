/// Whose frame coordinates are in: asked for, never guessed, since a frame that is taken for
/// another mirrors the organ.
#pragma once

#include <string>

#include "palpation/io/coordinates.h"

namespace palpation::tool {

/// The frame that a person named ("RAS", "LPS", or empty: none), or else the one that scene or mesh
/// tell. Throws IoError, beginning with `whose`, where both do and differ.
Frame frame_asked(const std::string& asked, Frame told, const std::string& whose);

/// Throws WrongUsage, beginning with the command's name and saying what to give, for a frame that
/// is no patient's: 3D Slicer must know.
void require_patients_frame(Frame frame, const std::string& command);

}  // namespace palpation::tool
