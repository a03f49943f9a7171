#include "io/files_read.h"

#include <sys/stat.h>

#include <algorithm>
#include <mutex>

namespace palpation {
namespace {

struct FileRead {
  std::filesystem::path path;
  dev_t device;
  ino_t inode;
};

std::mutex guard;

std::vector<FileRead>& list() {
  static std::vector<FileRead> files;
  return files;
}

bool is_listed(const struct ::stat& status) {
  return std::ranges::any_of(list(), [&](const FileRead& file) {
    return file.device == status.st_dev && file.inode == status.st_ino;
  });
}

}  // namespace

void note_file_read(const std::filesystem::path& path, const struct ::stat& status) {
  const std::lock_guard lock(guard);
  if (!is_listed(status)) list().push_back({path, status.st_dev, status.st_ino});
}

bool was_read(const struct ::stat& status) {
  const std::lock_guard lock(guard);
  return is_listed(status);
}

std::vector<std::filesystem::path> files_read() {
  const std::lock_guard lock(guard);
  std::vector<std::filesystem::path> paths;
  for (const FileRead& file : list()) paths.push_back(file.path);
  return paths;
}

}  // namespace palpation
