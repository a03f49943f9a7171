/// A file under a name, in memory: for tests that read tens of thousands of them.
#pragma once

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "io/temporary_folder.h"

namespace palpation {

class MemoryFile {
 public:
  /// The name, with its extension, is a link in the folder.
  MemoryFile(const TemporaryFolder& folder, const std::string& name)
      : descriptor_(::memfd_create("test", 0)), path_(folder.path() / name) {
    std::filesystem::remove(path_);
    std::filesystem::create_symlink("/proc/self/fd/" + std::to_string(descriptor_), path_);
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  /// Gives it these bytes and tells its path.
  const std::filesystem::path& with(const std::string& bytes) const {
    const bool written =
        ::ftruncate(descriptor_, 0) == 0 &&
        ::pwrite(descriptor_, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size());
    EXPECT_TRUE(written);
    return path_;
  }

 private:
  int descriptor_;
  std::filesystem::path path_;
};

}  // namespace palpation
