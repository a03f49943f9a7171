/// A file of lines that are checked one by one, to which lines are only added.
///
/// A line is "<16 hexadecimal digits> <JSON>": the digits are of the JSON's bytes (FNV-1a, 64
/// bits), the JSON has two members of the journal's own, "line" (from 1) and "synced": how many
/// lines were surely on the disk when it was written. Laws: (1) a line that was committed is read
/// back, or its loss is told by its number; (2) what is dropped at the end is torn (it has no line
/// end, or holds NUL bytes, as what a power cut left unwritten does), and no later line says that
/// it was on the disk; (3) who opens a journal to write syncs what is there before building on it.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "session/file_layer.h"

namespace palpation {

/// 16 hexadecimal digits.
std::string checksum_of(std::string_view text);

/// What a journal's bytes hold.
struct JournalText {
  std::vector<nlohmann::json> lines;
  std::size_t sound_bytes = 0;  ///< of whole lines; what follows is torn
  bool is_torn = false;
};

/// Throws IoError, naming the line, where one is corrupted.
JournalText parse_journal(std::string_view bytes, const std::string& name);

class Journal {
 public:
  /// Opens it, or makes it with the folders above. Throws IoError and WriteError.
  Journal(std::shared_ptr<FileLayer> files, std::filesystem::path path);

  /// The lines that were there.
  const std::vector<nlohmann::json>& lines() const { return lines_; }
  /// Whether torn ones were taken away.
  bool was_torn() const { return was_torn_; }

  /// A line of the next commit.
  void add(nlohmann::json line);
  /// All that was added is on the disk when this returns, in one write and one sync. Throws
  /// WriteError; then nothing can be added any more: what the file holds is only known once it is
  /// opened again.
  void commit();
  /// Whether all is on the disk.
  bool is_committed() const { return waiting_.empty(); }

 private:
  void require_sound() const;

  std::shared_ptr<FileLayer> files_;
  std::filesystem::path path_;
  std::shared_ptr<void> lock_;
  std::vector<nlohmann::json> lines_;
  bool was_torn_ = false;
  bool is_broken_ = false;
  std::size_t added_ = 0, synced_ = 0;  // lines
  std::string waiting_;                 // of the next commit
};

}  // namespace palpation
