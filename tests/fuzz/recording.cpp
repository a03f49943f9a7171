// Dense recordings as CSV, up to the world that answers from them.
#include "palpation/io/recording.h"

#include "fuzz/target.h"
#include "palpation/base/error.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace palpation;
  const fuzz::MemoryFile file(bytes, size);
  try {
    const RecordedReadings recording = read_recording(file.path());
    fuzz::expect(recording.readings.size() > 0, "a recording that was read has readings");
    if (recording.readings.size() > 400) return 0;
    const RecordedWorld world(fuzz::sheet(), {recording});
    fuzz::expect(world.map(0.0).allFinite(), "a map is finite");
  } catch (const Error&) {
  }
  return 0;
}
