// What a client says to palpate link: any bytes, cut anywhere.
#include "link/incoming.h"

#include <string_view>

#include "fuzz/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace palpation;
  const std::string_view all(reinterpret_cast<const char*>(bytes), size);
  link::Incoming at_once, in_pieces;
  const std::vector<link::Heard> heard = at_once.take(all);
  fuzz::expect(heard.size() <= size / 58, "a message has a header");
  std::size_t pieces = 0, at = 0;
  while (at < size) {
    const std::size_t step = 1 + bytes[at] % 61;
    for (const link::Heard& one : in_pieces.take(all.substr(at, step))) {
      fuzz::expect(pieces < heard.size() && one.type == heard[pieces].type &&
                       one.device == heard[pieces].device,
                   "how bytes are cut changes nothing");
      ++pieces;
    }
    at += step;
  }
  fuzz::expect(pieces == heard.size() && at_once.is_garbage() == in_pieces.is_garbage(),
               "how bytes are cut loses nothing");
  return 0;
}
