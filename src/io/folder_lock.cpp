#include "io/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
#include <system_error>

#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr const char* kStart = "palpate ";  // of what stands in the file

std::string reason(int error) { return std::generic_category().message(error); }

std::string now_utc() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

std::string host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "an unknown host";
}

/// A line, or nothing as long as the holder has not written it.
std::string words_in(int file) {
  std::array<char, 512> bytes{};
  const ssize_t count = ::pread(file, bytes.data(), bytes.size(), 0);
  const std::string text(bytes.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  return text.substr(0, text.find('\n'));
}

/// Whether the name still leads to the open file: a holder that ends takes the name away.
bool is_there(int file, const std::filesystem::path& path) {
  struct ::stat open {
  }, named{};
  return ::fstat(file, &open) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

int opened(const std::filesystem::path& path) {
  const int file =
      ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (file < 0) throw WriteError(path.string() + ": cannot write: " + reason(errno));
  return file;
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder, const std::string& command)
    : path_(folder / kLockName) {
  const auto refuse = [&](const std::string& words) {
    ::close(file_);
    throw WriteError(words);
  };
  do {
    if (file_ >= 0) ::close(file_);
    file_ = opened(path_);
    if (::flock(file_, LOCK_EX | LOCK_NB) == 0) continue;
    const int why = errno;
    const std::string holder = words_in(file_);
    if (why == EWOULDBLOCK)
      refuse(folder.string() + ": " + (holder.empty() ? "another palpate" : holder) +
             " is writing there: wait until it ends, or give another folder");
    refuse(path_.string() + ": cannot lock: " + reason(why));
  } while (!is_there(file_, path_));
  struct ::stat status {};
  ::fstat(file_, &status);
  if (!S_ISREG(status.st_mode) || (status.st_size > 0 && !words_in(file_).starts_with(kStart)))
    refuse(path_.string() + ": is no lock of palpate's: move it away, or give another folder");
  try {
    name_holder(command);
  } catch (...) {
    ::unlink(path_.c_str());
    ::close(file_);
    throw;
  }
}

/// The name goes while the lock is held: who opened the file in the meantime sees that it is gone.
FolderLock::~FolderLock() {
  ::unlink(path_.c_str());
  ::close(file_);
}

void FolderLock::name_holder(const std::string& command) const {
  const std::string words = kStart + command + " (process " + std::to_string(::getpid()) + " on " +
                            host() + ", since " + now_utc() + ")\n";
  const auto size = static_cast<ssize_t>(words.size());
  errno = ENOSPC;  // what a write that comes short does not say
  if (::ftruncate(file_, 0) != 0 || ::pwrite(file_, words.data(), words.size(), 0) != size)
    throw WriteError(path_.string() + ": cannot write: " + reason(errno));
}

}  // namespace palpation
