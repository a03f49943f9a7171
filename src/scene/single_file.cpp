#include "scene/single_file.h"

#include <signal.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <vector>

#include "io/files_read.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "scene/run_record.h"

namespace palpation::tool {

namespace fs = std::filesystem;

void refuse_to_replace(const std::filesystem::path& path, Existing existing) {
  struct ::stat status {};
  if (::stat(path.c_str(), &status) != 0) return;
  if (was_read(status))
    throw IoError(path.string() +
                  ": was read in this run, and would be replaced: give another name");
  if (existing == Existing::Kept)
    throw IoError(path.string() +
                  ": is there already: replace it by --overwrite, or give another name");
}

void write_single_file(const fs::path& path, const std::string& content, Existing existing) {
  if (fingerprint_of_file(path) == fingerprint_of_text(content)) return;
  refuse_to_replace(path, existing);
  remove_leftovers(path);
  write_atomically(path, content);
}

void remove_leftovers(const std::filesystem::path& path) {
  const std::string start = path.stem().string() + ".partial-";
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code ignored;  // writing says what is wrong with the folder
  std::vector<fs::path> left;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(start) || entry.path().extension() != path.extension()) continue;
    const std::string numbers = name.substr(start.size());  // of the process, and of the file
    const pid_t process = std::atoi(numbers.c_str());
    if (process > 0 && ::kill(process, 0) != 0 && errno == ESRCH) left.push_back(entry.path());
  }
  for (const fs::path& one : left) fs::remove(one, ignored);
}

}  // namespace palpation::tool
