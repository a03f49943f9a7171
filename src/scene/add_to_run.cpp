#include "scene/add_to_run.h"

#include <optional>

#include "io/folder_lock.h"
#include "palpation/io/atomic_file.h"
#include "scene/run_files.h"
#include "scene/run_record.h"
#include "scene/staging.h"

namespace palpation::tool {

void add_to_run(const std::filesystem::path& folder,
                const std::map<std::string, std::string>& contents, Existing existing) {
  std::optional<FolderLock> lock;
  if (read_run_record(folder)) lock.emplace(folder, "draw");
  std::optional<RunRecord> record = read_run_record(folder);
  const auto is_ours = [&](const std::string& name) {
    const std::optional<std::string> there = fingerprint_of_file(folder / name);
    return there && record && record->owns(name, *there);
  };
  for (const auto& [name, content] : contents)
    refuse_to_replace(folder / name, is_ours(name) ? Existing::Replaced : existing);
  if (!record) {
    for (const auto& [name, content] : contents) write_atomically(folder / name, content);
    return;
  }
  const Staging staging(folder);
  for (const auto& [name, content] : contents) record->files[name] = fingerprint_of_text(content);
  write_atomically(staging / kRecordName, document(*record));
  std::filesystem::rename(staging / kRecordName, folder / kRecordName);
  for (const auto& [name, content] : contents) write_atomically(folder / name, content);
}

}  // namespace palpation::tool
