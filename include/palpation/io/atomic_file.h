/// Files that are there whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace palpation {

/// Writes the content under a temporary name beside the path, then renames it: to the disk, the
/// folder's entry too. Nothing is written through a symbolic link, whose target is another's.
/// Throws WriteError with path and reason; the old file then stays.
void write_atomically(const std::filesystem::path& path, const std::string& content);

/// The same for writers that take a path: `write` gets the temporary name (same extension), which
/// is renamed once it returns.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write);

/// What was renamed in a folder stays renamed when the power fails. Throws WriteError.
void sync_folder(const std::filesystem::path& folder);

/// The whole file as bytes. Throws IoError if it is missing, a folder, unreadable or larger than
/// limit_bytes.
std::string read_file(const std::filesystem::path& path,
                      std::uintmax_t limit_bytes = std::uintmax_t{1} << 33);

}  // namespace palpation
