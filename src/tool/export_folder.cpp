#include "tool/export_folder.h"

#include <nlohmann/json.hpp>

#include "io/folder_lock.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "scene/make_folder.h"
#include "scene/run_files.h"
#include "scene/run_record.h"

namespace palpation::tool {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kListName = "export.json";
constexpr const char* kProgram = "palpate export";

/// Of an earlier export: names of files in this very folder, whatever else the list may say.
Fingerprints listed_in(const fs::path& folder) {
  if (!fingerprint_of_file(folder / kListName)) return {};
  const json list = json::parse(read_file(folder / kListName), nullptr, /*allow_exceptions=*/false);
  if (!list.is_object() || list.value("program", json()) != kProgram)
    throw IoError((folder / kListName).string() +
                  ": is none of palpate's, and would be replaced: give another folder");
  Fingerprints files;
  if (!list.contains("files") || !list["files"].is_object()) return files;
  for (const auto& [name, fingerprint] : list["files"].items())
    if (fs::path(name).filename() == name && name != ".." && fingerprint.is_string())
      files[name] = fingerprint;
  return files;
}

/// Fingerprints of what was and of what will be: whoever is killed in between, both are known as
/// ours.
bool is_ours(const fs::path& path, const std::string& name, const Fingerprints& earlier,
             const std::map<std::string, std::string>& contents) {
  const auto there = fingerprint_of_file(path);
  if (!there) return false;
  const auto before = earlier.find(name);
  if (before != earlier.end() && before->second == *there) return true;
  const auto now = contents.find(name);
  return now != contents.end() && fingerprint_of_text(now->second) == *there;
}

void refuse_run(const fs::path& folder) {
  if (read_run_record(folder))
    throw IoError(folder.string() + ": holds a run (" + kRecordName +
                  "): give another folder for what is exported from it");
}

void write_list(const fs::path& folder, const std::string& what, const Fingerprints& files) {
  json list = {{"program", kProgram}, {"for", what}, {"files", json::object()}};
  for (const auto& [name, fingerprint] : files) list["files"][name] = fingerprint;
  write_atomically(folder / kListName,
                   list.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

}  // namespace

void write_export(const fs::path& folder, const std::string& what,
                  const std::map<std::string, std::string>& contents, Existing existing) {
  refuse_run(folder);
  make_folder(folder);
  const FolderLock lock(folder, "export");
  const Fingerprints earlier = listed_in(folder);
  for (const auto& [name, unused] : contents) {
    const fs::path path = folder / name;
    if (fs::is_symlink(fs::symlink_status(path)))
      throw IoError(path.string() +
                    ": is a link, and nothing is written through one: give another folder");
    refuse_to_replace(path, is_ours(path, name, earlier, contents) ? Existing::Replaced : existing);
  }
  Fingerprints now;
  for (const auto& [name, content] : contents) now[name] = fingerprint_of_text(content);
  Fingerprints both = earlier;
  for (const auto& [name, fingerprint] : now) both[name] = fingerprint;
  write_list(folder, what, both);
  for (const auto& [name, content] : contents) write_atomically(folder / name, content);
  for (const auto& [name, unused] : earlier)
    if (!contents.contains(name) && is_ours(folder / name, name, earlier, contents))
      fs::remove(folder / name);
  write_list(folder, what, now);
}

}  // namespace palpation::tool
