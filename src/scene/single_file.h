/// Files that are written one by one, to a name that a person gave: meshes, tables.
#pragma once

#include <filesystem>
#include <string>

namespace palpation::tool {

/// What becomes of a file that is there already.
enum class Existing { Kept, Replaced };

/// Refuses to write over a file that was read in this process, or that is to be kept. Throws
/// IoError.
void refuse_to_replace(const std::filesystem::path& path, Existing existing);

/// Refuses as above, but the same bytes again are no loss.
void write_single_file(const std::filesystem::path& path, const std::string& content,
                       Existing existing);

/// Takes away what a process that died while it wrote this file left beside it.
void remove_leftovers(const std::filesystem::path& path);

}  // namespace palpation::tool
