#include "scene/make_folder.h"

#include "palpation/base/error.h"

namespace palpation::tool {

void make_folder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure || !std::filesystem::is_directory(folder))
    throw WriteError(folder.string() + ": cannot make this folder: " +
                     (failure ? failure.message() : "there is a file of that name"));
}

}  // namespace palpation::tool
