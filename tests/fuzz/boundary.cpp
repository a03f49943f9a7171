// Boundaries as VTP.
#include "fuzz/target.h"
#include "palpation/base/error.h"
#include "palpation/io/read_boundary.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace palpation;
  const fuzz::MemoryFile file(bytes, size);
  try {
    fuzz::expect(read_boundary_vtp(file.path(), fuzz::sheet()).region.area() >= 0.0,
                 "an area is not negative");
  } catch (const InvalidInput&) {
  } catch (const IoError&) {
  }
  return 0;
}
