/// A session as messages, while it goes: at once what its journal says, and some time later what
/// follows from it.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "link/concluder.h"
#include "link/link_server.h"
#include "link/probe_pose.h"
#include "link/session_watch.h"

namespace palpation::link {

class LiveSession {
 public:
  /// Throws IoError where the folder holds no session, a damaged one, or one of another scene.
  LiveSession(const std::filesystem::path& folder, const tool::Scene& scene,
              const tool::Tissue& tissue, Frame frame);

  /// Shows what is new, if anything is. What goes wrong from now on, such as a journal that was
  /// damaged, is shown as the status, and what was shown stays; returns it in words, once.
  std::string look(LinkServer& server);

 private:
  std::string look_at_journal(LinkServer& server);
  std::string look_at_conclusion(LinkServer& server);
  void show_journal(LinkServer& server) const;
  void show_tissue(LinkServer& server) const;
  void show_status(LinkServer& server) const;
  std::string stale_words(const SessionIdentity& now) const;

  tool::Tissue tissue_;
  Frame frame_;
  SessionIdentity identity_;
  SessionWatch watch_;
  ProbePath path_;
  Concluder concluder_;
  SessionState state_;
  std::optional<ProbePose> pose_;
  std::optional<std::size_t> concluded_rows_;
  std::map<int, std::string> set_aside_;  // by the latest conclusion
  std::string fault_;                     // of what was looked at last; empty: none
  bool is_new_ = true;                    // nothing was shown yet
};

}  // namespace palpation::link
