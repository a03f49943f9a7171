/// What follows from a session's readings, worked out beside the clients: it may take seconds, and
/// nobody waits for it.
#pragma once

#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "link/link_server.h"
#include "palpation/session/session_state.h"
#include "scene/tissue.h"

namespace palpation::link {

/// Messages to be shown, or why there are none.
struct Concluded {
  std::vector<Shown> messages{};
  std::map<int, std::string> set_aside{};  ///< rows that are not used, with the reason
  std::size_t rows = 0;                    ///< that it was worked out from
  std::string fault{};                     ///< empty: there is none
};

/// The same in the caller's own thread. Throws what the arithmetic throws.
Concluded concluded(const tool::Scene& scene, const tool::Tissue& tissue, Frame frame,
                    const SessionState& state);

/// A thread that gives way to all others of the machine. Of what it is asked while it works only
/// the latest is worked out.
class Concluder {
 public:
  Concluder(tool::Scene scene, tool::Tissue tissue, Frame frame);
  /// Ends what is under way, mostly within a tenth of a second.
  ~Concluder();

  void ask(SessionState state);
  std::optional<Concluded> done();
  bool is_busy() const;

 private:
  void work();
  Concluded answer(const SessionState& state) const;

  tool::Scene scene_;
  tool::Tissue tissue_;
  Frame frame_;
  mutable std::mutex guard_;  // of asked_, done_ and is_busy_
  std::condition_variable news_;
  std::optional<SessionState> asked_;
  std::optional<Concluded> done_;
  bool is_busy_ = false;
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

}  // namespace palpation::link
