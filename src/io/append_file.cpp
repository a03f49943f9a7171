#include "io/append_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"

namespace palpation {
namespace {

std::string reason() { return std::generic_category().message(errno); }

void write_all(int file, std::string_view text, const std::filesystem::path& path) {
  while (!text.empty()) {
    const ssize_t count = ::write(file, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw WriteError(path.string() + ": cannot write: " + reason());
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

/// File systems without fsync say EINVAL.
void sync(int file, const std::filesystem::path& path) {
  if (::fdatasync(file) != 0 && errno != EINVAL && errno != EROFS)
    throw WriteError(path.string() + ": cannot write: " + reason());
}

/// So that a file that was just made is found after a power cut.
void sync_folder_of(const std::filesystem::path& path) {
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  ::fsync(file);
  ::close(file);
}

}  // namespace

AppendFile::AppendFile(std::filesystem::path path) : path_(std::move(path)) {
  // O_NONBLOCK: a pipe of that name must not hold the program up.
  constexpr int kHow = O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
  file_ = ::open(path_.c_str(), kHow, 0666);
  if (file_ < 0) throw WriteError(path_.string() + ": cannot open to append to: " + reason());
  try {
    struct ::stat status {};
    if (::fstat(file_, &status) != 0 || !S_ISREG(status.st_mode))
      throw IoError(path_.string() + ": is no regular file");
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0)
      throw IoError(path_.string() + ": another process is writing to it");
    content_ = read_file(path_);
    const std::size_t whole = content_.rfind('\n') + 1;  // 0 where there is none
    was_torn_ = whole < content_.size();
    if (was_torn_ && ::ftruncate(file_, static_cast<off_t>(whole)) != 0)
      throw WriteError(path_.string() + ": cannot write: " + reason());
    content_.resize(whole);
    sync_folder_of(path_);
  } catch (...) {
    ::close(file_);
    throw;
  }
}

AppendFile::~AppendFile() { ::close(file_); }

void AppendFile::append(std::string_view lines) {
  const off_t before = ::lseek(file_, 0, SEEK_END);
  try {
    write_all(file_, lines, path_);
    sync(file_, path_);
  } catch (const WriteError&) {
    if (::ftruncate(file_, before) != 0) {
      // The next to open the file takes the rest of a line away.
    }
    throw;
  }
}

/// By renaming: the lock moves on to the new file.
void AppendFile::replace(std::string_view lines) {
  write_atomically(path_, std::string(lines));
  const int file = ::open(path_.c_str(), O_RDWR | O_APPEND | O_CLOEXEC | O_NOFOLLOW);
  if (file < 0 || ::flock(file, LOCK_EX | LOCK_NB) != 0) {
    if (file >= 0) ::close(file);
    throw WriteError(path_.string() + ": cannot open to append to: " + reason());
  }
  ::close(std::exchange(file_, file));
}

}  // namespace palpation
