#include "palpation/io/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <system_error>
#include <utility>

#include "io/cannot_read.h"
#include "io/files_read.h"

namespace palpation {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

/// An open file that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  /// Closes now: the last chance of the system to report a failed write.
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

/// Removes the temporary file unless it was renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(fs::path path) : path_(std::move(path)) {}
  ~TemporaryFile() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const fs::path& path() const { return path_; }
  void keep() { path_.clear(); }

 private:
  fs::path path_;
};

[[noreturn]] void fail_to_write(const fs::path& path, const std::string& why) {
  throw WriteError(path.string() + ": cannot write: " + why);
}

/// Renaming must replace neither a folder nor a device; and what lies behind a link is another's.
void refuse_what_is_no_file(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(path, ignored);
  if (!fs::exists(status) || fs::is_regular_file(status)) return;
  fail_to_write(path, fs::is_directory(status) ? "is a folder"
                      : fs::is_symlink(status) ? "is a link, and nothing is written through one"
                                               : "is no regular file");
}

/// Beside the file, so that renaming stays within one file system; unique in this process and among
/// processes.
fs::path temporary_name(const fs::path& path) {
  static std::atomic<unsigned> counter{0};
  const std::string mark =
      ".partial-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
  return path.parent_path() / (path.stem().string() + mark + path.extension().string());
}

void write_all(const Descriptor& file, const std::string& content, const fs::path& path) {
  std::size_t written = 0;
  while (written < content.size()) {
    const ssize_t count =
        ::write(file.number(), content.data() + written, content.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail_to_write(path, reason(errno));
    written += static_cast<std::size_t>(count);
  }
}

/// File systems without fsync say EINVAL.
void to_disk(const Descriptor& file, const fs::path& path) {
  if (::fsync(file.number()) != 0 && errno != EINVAL && errno != EROFS)
    fail_to_write(path, reason(errno));
}

/// To the disk, then under its name: a crash in between leaves the old file.
void finish(Descriptor& file, TemporaryFile& temporary, const fs::path& path) {
  to_disk(file, path);
  if (!file.close()) fail_to_write(path, reason(errno));
  if (::rename(temporary.path().c_str(), path.c_str()) != 0) fail_to_write(path, reason(errno));
  temporary.keep();
  sync_folder(path.parent_path());
}

}  // namespace

void sync_folder(const fs::path& folder) {
  const fs::path named = folder.empty() ? fs::path(".") : folder;
  const Descriptor open(::open(named.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (open.is_open()) return to_disk(open, named);
  if (errno != EACCES) fail_to_write(named, reason(errno));  // a folder that may not be listed
}

void write_atomically(const fs::path& path, const std::string& content) {
  refuse_what_is_no_file(path);
  const fs::path name = temporary_name(path);
  Descriptor file(::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!file.is_open()) fail_to_write(path, reason(errno));
  TemporaryFile temporary(name);
  write_all(file, content, path);
  finish(file, temporary, path);
}

void write_atomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  refuse_what_is_no_file(path);
  TemporaryFile temporary(temporary_name(path));
  write(temporary.path());
  Descriptor file(::open(temporary.path().c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.is_open()) fail_to_write(path, "the writer left no file: " + reason(errno));
  finish(file, temporary, path);
}

std::string read_file(const fs::path& path, std::uintmax_t limit_bytes) {
  const auto fail = [&](const std::string& why) {
    throw CannotRead(path.string() + ": cannot read: " + why);
  };
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file.is_open()) fail(reason(errno));
  struct ::stat status {};
  if (::fstat(file.number(), &status) != 0) fail(reason(errno));
  if (S_ISDIR(status.st_mode)) fail("is a folder");
  if (!S_ISREG(status.st_mode)) fail("is no regular file");
  note_file_read(path, status);
  const auto size = static_cast<std::uintmax_t>(status.st_size);
  if (size > limit_bytes)
    fail(std::to_string(size) + " bytes are more than the limit of " + std::to_string(limit_bytes));
  std::string content(size, '\0');
  std::size_t filled = 0;
  while (filled < content.size()) {
    const ssize_t count = ::read(file.number(), content.data() + filled, content.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(reason(errno));
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  content.resize(filled);
  return content;
}

}  // namespace palpation
