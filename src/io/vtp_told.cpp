#include "io/vtp_told.h"

#include "io/number_text.h"
#include "io/vtp_file.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

/// Frame and space are one statement in two words.
void take_frame(const MeshSource& source, const VtpArray& array, Frame frame,
                ToldCoordinates& told) {
  if (told.frame && *told.frame != frame)
    source.fail_at_byte(array.place, "its field data contradict themselves: " + array.name +
                                         " is " + name_of(frame) + " here, and " +
                                         name_of(*told.frame) + " before");
  told.frame = frame;
}

}  // namespace

ToldCoordinates told_coordinates(const MeshSource& source, VtpFile& file) {
  ToldCoordinates told;
  for (const VtpArray& array : file.field_texts()) {
    const bool is_unit = array.name == "UNIT";
    if (!is_unit && array.name != "FRAME" && array.name != "SPACE") continue;
    const std::string word = file.numbers().texts(array, 1, "field data " + array.name).front();
    try {
      if (is_unit) {
        told.unit = length_unit(word);
      } else {
        take_frame(source, array, frame_of(word), told);
      }
    } catch (const InvalidInput&) {
      told.not_understood.push_back(array.name + " = " + in_quotes(word));
    }
  }
  return told;
}

}  // namespace palpation
