#include "session/journal.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "palpation/base/error.h"

namespace palpation {
namespace {

using nlohmann::json;

constexpr std::size_t kDigits = 16;

/// What a line holds; nothing if it is not as it was written.
std::optional<json> checked(std::string_view line) {
  if (line.size() <= kDigits + 1 || line[kDigits] != ' ') return std::nullopt;
  const std::string_view text = line.substr(kDigits + 1);
  if (line.substr(0, kDigits) != checksum_of(text)) return std::nullopt;
  json what = json::parse(text, nullptr, false);
  if (!what.is_object() || !what["line"].is_number_unsigned() ||
      !what["synced"].is_number_unsigned())
    return std::nullopt;
  return what;
}

/// The first line after this place that says that line `number` was on the disk; 0: none.
std::size_t witness_of(std::size_t number, std::string_view rest) {
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::optional<json> what = checked(rest.substr(0, end));
    if (what && (*what)["synced"].get<std::size_t>() >= number)
      return (*what)["line"].get<std::size_t>();
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return 0;
}

[[noreturn]] void refuse(const std::string& name, std::size_t number, const std::string& words) {
  throw IoError(name + ":" + std::to_string(number) + ": " + words);
}

/// A line that is not as it was written: lost in a power cut, or changed since.
void judge(std::string_view line, bool has_end, std::string_view rest, std::size_t number,
           const std::string& name) {
  if (const std::size_t witness = witness_of(number, rest); witness > 0)
    refuse(name, number,
           "this line is corrupted: line " + std::to_string(witness) +
               " says that it was on the disk, so it was changed since. Restore it from a copy");
  const bool is_torn = !has_end || line.find('\0') != std::string_view::npos;
  if (!is_torn)
    refuse(name, number,
           number == 1 ? "this is no line of a session's journal"
                       : "this line is corrupted: it is whole, but its checksum is of other bytes. "
                         "Restore it from a copy, or take away this line and all after it");
}

/// The folders from the first to the last, each above the next.
std::vector<std::filesystem::path> folders_to(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> folders;
  for (std::filesystem::path at = folder; !at.empty(); at = at.parent_path()) {
    folders.push_back(at);
    if (at == at.parent_path()) break;
  }
  std::reverse(folders.begin(), folders.end());
  return folders;
}

/// Folders that are there may have been made by a process that died before it could sync them.
void make_folders(FileLayer& files, const std::filesystem::path& folder) {
  for (const std::filesystem::path& at : folders_to(folder)) {
    if (!files.exists(at)) files.make_folder(at);
    if (at != at.parent_path()) files.sync_folder(at.parent_path());
  }
}

}  // namespace

std::string checksum_of(std::string_view text) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char byte : text) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  std::string digits(kDigits, '0');
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit, hash >>= 4)
    *digit = "0123456789abcdef"[hash & 15];
  return digits;
}

JournalText parse_journal(std::string_view bytes, const std::string& name) {
  JournalText text;
  while (text.sound_bytes < bytes.size()) {
    const std::string_view rest = bytes.substr(text.sound_bytes);
    const std::size_t end = rest.find('\n');
    const bool has_end = end != std::string_view::npos;
    const std::string_view line = rest.substr(0, end);
    const std::size_t number = text.lines.size() + 1;
    std::optional<json> what = has_end ? checked(line) : std::nullopt;
    if (!what) {
      judge(line, has_end, has_end ? rest.substr(end + 1) : std::string_view(), number, name);
      text.is_torn = true;
      return text;
    }
    if ((*what)["line"] != number)
      refuse(name, number,
             "this line calls itself line " + (*what)["line"].dump() +
                 ": lines were taken away or put in. Restore the file from a copy");
    text.lines.push_back(std::move(*what));
    text.sound_bytes += end + 1;
  }
  return text;
}

Journal::Journal(std::shared_ptr<FileLayer> files, std::filesystem::path path)
    : files_(std::move(files)), path_(std::move(path)) {
  make_folders(*files_, path_.parent_path());
  lock_ = files_->lock(path_.parent_path());
  if (!files_->exists(path_)) files_->append(path_, "");
  const std::string bytes = files_->read(path_);
  JournalText text = parse_journal(bytes, path_.string());
  if (text.sound_bytes < bytes.size()) files_->truncate(path_, text.sound_bytes);
  files_->sync(path_);
  files_->sync_folder(path_.parent_path());
  lines_ = std::move(text.lines);
  was_torn_ = text.is_torn;
  added_ = synced_ = lines_.size();
}

void Journal::require_sound() const {
  if (is_broken_)
    throw WriteError(path_.string() +
                     ": could not be written, and what it holds now is not known: open the "
                     "session again");
}

void Journal::add(json line) {
  require_sound();
  line["line"] = ++added_;
  line["synced"] = synced_;
  // Text that is no UTF-8 must not stop a reading: what is none of it is replaced.
  const std::string text = line.dump(-1, ' ', true, json::error_handler_t::replace);
  waiting_ += checksum_of(text) + " " + text + "\n";
}

void Journal::commit() {
  require_sound();
  if (waiting_.empty()) return;
  is_broken_ = true;  // unless all of the following succeeds
  files_->append(path_, waiting_);
  files_->sync(path_);
  is_broken_ = false;
  waiting_.clear();
  synced_ = added_;
}

}  // namespace palpation
