#include "scene/make_folder.h"

#include "palpation/base/error.h"

namespace palpation::tool {

void make_folder(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::error_code failure, ignored;
  fs::create_directories(folder, failure);
  if (!failure && fs::is_directory(folder)) return;
  const bool leads_nowhere = fs::is_symlink(folder, ignored) && !fs::exists(folder, ignored);
  throw WriteError(folder.string() + ": cannot make this folder: " +
                   (leads_nowhere ? "there is a link of that name, which leads nowhere"
                    : failure     ? failure.message()
                                  : "there is a file of that name"));
}

}  // namespace palpation::tool
