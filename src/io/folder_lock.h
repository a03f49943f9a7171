/// One writer per folder: a lock that names who holds it, and ends with the process that does.
#pragma once

#include <filesystem>
#include <string>

namespace palpation {

inline constexpr const char* kLockName = ".palpate-lock";

class FolderLock {
 public:
  /// Throws WriteError where another process holds it (naming command, process, host and since
  /// when), or where there can be none. Of a process that died only the file is left: it is taken
  /// over.
  FolderLock(const std::filesystem::path& folder, const std::string& command);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  void name_holder(const std::string& command) const;

  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace palpation
