/// What the coordinates of a file are: in which unit, and in whose frame.
///
/// VTP files say so in their field data, as texts: UNIT ("mm", "cm" or "m"), FRAME ("mesh", "RAS"
/// or "LPS"), and for the frames of a patient SPACE with the same word, which 3D Slicer goes by.
#pragma once

#include <string>

namespace palpation {

enum class LengthUnit { Millimetre, Centimetre, Metre };

/// "mm", "cm" or "m"; throws InvalidInput for anything else.
LengthUnit length_unit(const std::string& name);

enum class Frame {
  Mesh,  ///< the mesh file's own: nobody registered it to a patient
  Ras,   ///< x to the patient's right, y to the front (anterior), z to the head (superior)
  Lps,   ///< x to the left, y to the back (posterior), z to the head
};

/// "mesh", "RAS" or "LPS".
std::string name_of(Frame frame);
/// The same backwards; throws InvalidInput for anything else.
Frame frame_of(const std::string& name);

}  // namespace palpation
