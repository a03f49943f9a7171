#include "scene/patient_frame.h"

#include "palpation/base/error.h"
#include "scene/exit_code.h"

namespace palpation::tool {

Frame frame_asked(const std::string& asked, Frame told, const std::string& whose) {
  const Frame frame = asked.empty() ? told : frame_of(asked);
  if (told != Frame::Mesh && frame != told)
    throw IoError(whose + ": its coordinates are " + name_of(told) +
                  ", as its scene or its mesh says, and --frame " + asked +
                  " would mirror them: leave --frame out, or correct surface.frame and run again");
  return frame;
}

void require_patients_frame(Frame frame, const std::string& command) {
  if (frame != Frame::Mesh) return;
  throw WrongUsage(
      command +
      ": 3D Slicer must know whose frame the coordinates are in, and neither the scene "
      "(surface.frame) nor the mesh's file says: give --frame RAS where x grows to the patient's "
      "right and y to the front, as in Slicer itself, or --frame LPS where they grow to the left "
      "and to the back, as in DICOM. For a phantom, which is nobody, either shows it");
}

}  // namespace palpation::tool
