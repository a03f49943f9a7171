#include "palpation/io/coordinates.h"

#include <array>

#include "io/length_scale.h"
#include "palpation/base/error.h"

namespace palpation {

LengthUnit length_unit(const std::string& name) {
  for (const LengthUnit unit :
       {LengthUnit::Millimetre, LengthUnit::Centimetre, LengthUnit::Metre}) {
    if (name == name_of(unit)) return unit;
  }
  throw InvalidInput("length_unit: \"" + name + "\" must be mm, cm or m");
}

std::string name_of(Frame frame) {
  switch (frame) {
    case Frame::Mesh:
      return "mesh";
    case Frame::Ras:
      return "RAS";
    case Frame::Lps:
      return "LPS";
  }
  throw InvalidInput("name_of: frame " + std::to_string(static_cast<int>(frame)) +
                     " does not exist");
}

Frame frame_of(const std::string& name) {
  for (const Frame frame : {Frame::Mesh, Frame::Ras, Frame::Lps}) {
    if (name == name_of(frame)) return frame;
  }
  throw InvalidInput("frame_of: \"" + name + "\" must be mesh, RAS or LPS");
}

}  // namespace palpation
