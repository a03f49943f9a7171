#include "scene/staging.h"

#include <algorithm>
#include <vector>

#include "palpation/base/error.h"
#include "scene/make_folder.h"
#include "scene/run_files.h"

namespace palpation::tool {
namespace {

namespace fs = std::filesystem;

bool is_ours(const std::string& name) {
  return name == kRecordName || is_step(name) || is_partial(name) ||
         std::ranges::find(kRunFiles, name) != kRunFiles.end();
}

/// Only what a run writes, and nothing behind a link.
void clear(const fs::path& folder) {
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
  for (const fs::path& entry : entries) {
    const bool is_folder = fs::is_directory(fs::symlink_status(entry));
    if (is_folder && entry.filename() == kStepsName) {
      clear(entry);
    } else if (is_folder || !is_ours(entry.filename().string())) {
      throw WriteError(entry.string() +
                       ": is none of palpate's: move it away, or give another folder");
    }
    fs::remove(entry);
  }
}

void remove_staging(const fs::path& path) {
  const fs::file_status status = fs::symlink_status(path);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status))
    throw WriteError(path.string() + ": is no folder: move it away, or give another folder");
  clear(path);
  fs::remove(path);
}

}  // namespace

Staging::Staging(const fs::path& folder) : path_(folder / kStagingName) {
  try {
    remove_staging(path_);
  } catch (const fs::filesystem_error& error) {
    throw WriteError(path_.string() +
                     ": cannot remove what an earlier run left: " + error.code().message());
  }
  make_folder(path_);
}

Staging::~Staging() {
  if (kept_) return;
  try {
    remove_staging(path_);
  } catch (const std::exception&) {  // the next run tells what is in its way
  }
}

std::string Staging::without(std::string words) const {
  const std::string name = std::string(kStagingName) + "/";
  for (std::size_t at = words.find(name); at != std::string::npos; at = words.find(name))
    words.erase(at, name.size());
  return words;
}

}  // namespace palpation::tool
