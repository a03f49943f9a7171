/// Pictures that are drawn later, from the files of a run: they become the run's.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "scene/single_file.h"

namespace palpation::tool {

/// Writes contents by name into a folder. Where that holds a run, run.json lists them from then on,
/// and what it lists already is replaced. Throws IoError where a file would be lost, WriteError
/// where nothing can be written.
void add_to_run(const std::filesystem::path& folder,
                const std::map<std::string, std::string>& contents, Existing existing);

}  // namespace palpation::tool
