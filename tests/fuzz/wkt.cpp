// Outlines as well-known text, up to the Booleans of them.
#include "palpation/io/wkt.h"

#include "fuzz/target.h"
#include "palpation/base/error.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace palpation;
  const fuzz::MemoryFile file(bytes, size);
  try {
    const Region region = read_wkt(file.path()).region;
    fuzz::expect(region.area() >= 0.0, "an area is not negative");
    fuzz::expect(symmetric_difference(region, region).empty(),
                 "a region does not differ from itself");
    fuzz::expect(to_wkt(region).starts_with("MULTIPOLYGON"), "a region is a multipolygon");
  } catch (const InvalidInput&) {
  } catch (const IoError&) {
  }
  return 0;
}
