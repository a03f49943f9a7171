#include "link/session_watch.h"

#include <sys/stat.h>

#include <utility>

#include "palpation/base/error.h"
#include "session/entries.h"

namespace palpation::link {

SessionWatch::SessionWatch(std::filesystem::path folder)
    : folder_(std::move(folder)), journal_(folder_ / kJournalName) {}

SessionWatch::Mark SessionWatch::mark_now() const {
  struct ::stat now {};
  if (::stat(journal_.c_str(), &now) != 0) return {};
  return {now.st_ino, now.st_size, now.st_mtim.tv_sec, now.st_mtim.tv_nsec};
}

std::optional<SessionState> SessionWatch::changed() {
  const Mark now = mark_now();
  if (seen_ == now) return std::nullopt;
  seen_ = now;  // before reading: what is written meanwhile is seen the next time
  if (now == Mark{})
    throw IoError(folder_.string() + ": holds no session, which would be " + kJournalName +
                  " in it: palpate session SCENE.json DIR next begins one");
  return read_session(folder_);
}

}  // namespace palpation::link
