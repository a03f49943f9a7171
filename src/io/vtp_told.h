/// What the field data of a VTP file say of its coordinates.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpation/io/coordinates.h"

namespace palpation {

class VtpFile;
struct MeshSource;

struct ToldCoordinates {
  std::optional<LengthUnit> unit;
  std::optional<Frame> frame;
  std::vector<std::string> not_understood;  ///< "UNIT = \"inch\"": words that mean nothing here
};

/// Reads UNIT, FRAME and SPACE, each a text by itself; what else lies there is left alone. Throws
/// IoError naming the byte where two of them contradict each other, or the bytes of one are
/// damaged.
ToldCoordinates told_coordinates(const MeshSource& source, VtpFile& file);

}  // namespace palpation
