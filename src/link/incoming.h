/// What a client says: OpenIGTLink's messages out of bytes as they come.
///
/// Laws: (1) whatever the bytes are and however they are cut, nothing but the headers of requests
/// is kept, so memory does not grow; (2) bodies are passed over, whatever they hold; (3) bytes that
/// cannot be a header are garbage, and so is all that follows: where the next message begins is not
/// known any more.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace palpation::link {

/// A header: "GET_STATUS" and of which device, which may be empty.
struct Heard {
  std::string type, device;
};

class Incoming {
 public:
  /// The messages whose headers are whole with these bytes.
  std::vector<Heard> take(std::string_view bytes);
  bool is_garbage() const { return is_garbage_; }

 private:
  std::string header_;            // as much of it as came
  std::uint64_t body_bytes_ = 0;  // still to be passed over
  bool is_garbage_ = false;
};

}  // namespace palpation::link
