/// The few things that a journal does to files: the machine's own, or a test's that forgets.
///
/// What was appended or made may be forgotten by a power cut until it is synced: bytes by sync, the
/// name of a file or a folder by sync_folder of the folder that it stands in. A process that dies
/// forgets nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace palpation {

class FileLayer {
 public:
  FileLayer() = default;
  virtual ~FileLayer() = default;
  FileLayer(const FileLayer&) = delete;
  FileLayer& operator=(const FileLayer&) = delete;

  virtual bool exists(const std::filesystem::path& path) = 0;
  /// One level; nothing where there is one.
  virtual void make_folder(const std::filesystem::path& path) = 0;
  /// All bytes of a file, at most 1 GiB. Throws IoError.
  virtual std::string read(const std::filesystem::path& path) = 0;
  /// Makes the file where there is none. Throws WriteError; then any part may have been written.
  virtual void append(const std::filesystem::path& path, std::string_view bytes) = 0;
  virtual void truncate(const std::filesystem::path& path, std::uintmax_t size) = 0;
  virtual void sync(const std::filesystem::path& path) = 0;
  virtual void sync_folder(const std::filesystem::path& path) = 0;
  /// Keeps other writers out of a folder, as long as what it returns lives.
  virtual std::shared_ptr<void> lock(const std::filesystem::path& folder) = 0;
};

/// The machine's.
std::shared_ptr<FileLayer> disk_layer();

}  // namespace palpation
