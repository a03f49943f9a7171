#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "io/folder_lock.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "session/file_layer.h"

namespace palpation {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 30;

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw WriteError(path.string() + ": cannot " + what + ": " +
                   std::generic_category().message(errno));
}

/// A file that is held open, so that appending and syncing a line cost one call each.
class OpenFile {
 public:
  explicit OpenFile(const fs::path& path) : path_(path) {
    // O_NONBLOCK: a pipe of that name must not hold the program up.
    constexpr int kHow = O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
    file_ = ::open(path.c_str(), kHow, 0666);
    if (file_ < 0) fail(path, "open to append to");
    struct ::stat status {};
    if (::fstat(file_, &status) == 0 && S_ISREG(status.st_mode)) return;
    ::close(file_);
    throw IoError(path.string() + ": is no regular file");
  }
  ~OpenFile() { ::close(file_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  const fs::path& path() const { return path_; }

  void append(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count = ::write(file_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail(path_, "write");
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
  }
  void truncate(std::uintmax_t size) {
    if (::ftruncate(file_, static_cast<off_t>(size)) != 0) fail(path_, "write");
  }
  /// File systems without fsync say EINVAL.
  void sync() {
    if (::fsync(file_) != 0 && errno != EINVAL) fail(path_, "write");
  }

 private:
  fs::path path_;
  int file_ = -1;
};

class DiskLayer : public FileLayer {
 public:
  bool exists(const fs::path& path) override {
    return fs::symlink_status(path).type() != fs::file_type::not_found;
  }
  void make_folder(const fs::path& path) override {
    std::error_code failure;
    fs::create_directory(path, failure);
    if (failure || !fs::is_directory(path))
      throw WriteError(path.string() + ": cannot make this folder: " +
                       (failure ? failure.message() : "there is a file of that name"));
  }
  std::string read(const fs::path& path) override { return read_file(path, kMostBytes); }
  void append(const fs::path& path, std::string_view bytes) override { opened(path).append(bytes); }
  void truncate(const fs::path& path, std::uintmax_t size) override { opened(path).truncate(size); }
  void sync(const fs::path& path) override { opened(path).sync(); }
  /// One that may not be opened is another's, who made it long ago.
  void sync_folder(const fs::path& path) override {
    const int file = ::open(path.empty() ? "." : path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0 && errno == EACCES) return;
    if (file < 0) fail(path, "open");
    const bool is_synced = ::fsync(file) == 0 || errno == EINVAL || errno == EROFS;
    const int why = errno;
    ::close(file);
    errno = why;
    if (!is_synced) fail(path, "write");
  }
  std::shared_ptr<void> lock(const fs::path& folder) override {
    return std::make_shared<FolderLock>(folder, "session");
  }

 private:
  OpenFile& opened(const fs::path& path) {
    if (!file_ || file_->path() != path) file_ = std::make_unique<OpenFile>(path);
    return *file_;
  }

  std::unique_ptr<OpenFile> file_;  // the last one: a journal has but one
};

}  // namespace

std::shared_ptr<FileLayer> disk_layer() { return std::make_shared<DiskLayer>(); }

}  // namespace palpation
