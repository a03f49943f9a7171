/// Which files were read in this process: what a program was given, it must not write over.
#pragma once

#include <filesystem>
#include <vector>

struct stat;

namespace palpation {

/// Remembers an open file, by its inode: it may have many names. Safe from several threads.
void note_file_read(const std::filesystem::path& path, const struct ::stat& status);

/// Whether that file was read, under whatever name.
bool was_read(const struct ::stat& status);

/// All of them, by the names under which they were read, in order, each once.
std::vector<std::filesystem::path> files_read();

}  // namespace palpation
