/// A folder that there must be.
#pragma once

#include <filesystem>

namespace palpation::tool {

/// Makes a folder, and those above it, if it is not there. Throws WriteError.
void make_folder(const std::filesystem::path& folder);

}  // namespace palpation::tool
