/// A session's folder, looked at again and again while another process writes it.
///
/// It only reads, and takes no lock: the writer notices nothing. What is looked at first is cheap
/// (the size of the journal and when it was written), so that looking often costs nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "palpation/session/session_state.h"

namespace palpation::link {

class SessionWatch {
 public:
  explicit SessionWatch(std::filesystem::path folder);

  /// What the session holds now, unless that is what it held at the last call. Throws IoError where
  /// there is no session, and for a journal that is damaged; then not again until it changes.
  std::optional<SessionState> changed();

 private:
  struct Mark {
    std::uint64_t file = 0;
    std::int64_t bytes = -1, seconds = 0, nanoseconds = 0;
    bool operator==(const Mark&) const = default;
  };
  Mark mark_now() const;

  std::filesystem::path folder_, journal_;
  std::optional<Mark> seen_;
};

}  // namespace palpation::link
