/// A file that only grows, line by line, and forgets nothing that it acknowledged.
///
/// A line is on the disk when append() returns. Who dies in the middle of one leaves a line without
/// its end, which the next one to open the file takes away: it was never acknowledged. One process
/// may have the file open.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace palpation {

class AppendFile {
 public:
  /// Opens the file, or makes it. Throws IoError if it is no regular file, or if another process
  /// has it open; WriteError if it cannot be written.
  explicit AppendFile(std::filesystem::path path);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// The whole lines that the file held when it was opened.
  const std::string& content() const { return content_; }
  /// Whether a line without its end was taken away then.
  bool was_torn() const { return was_torn_; }

  /// Adds lines, each with its end, and returns when they are on the disk. Throws WriteError; then
  /// the file is as it was before, or ends in a line without its end.
  void append(std::string_view lines);
  /// The same content, in place of what is there.
  void replace(std::string_view lines);

 private:
  std::filesystem::path path_;
  int file_ = -1;
  std::string content_;
  bool was_torn_ = false;
};

}  // namespace palpation
