/// The folder of an export: its files stay those that were written, until they are written again.
///
/// export.json lists them with fingerprints of their bytes. Laws: (1) a file that it does not list
/// with these very bytes is a person's, and is replaced only where that is asked for; (2) what an
/// earlier export left and this one does not write is removed, unless it was changed; (3) nothing
/// is written through a link, nor into the folder of a run.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "scene/single_file.h"

namespace palpation::tool {

/// `what`: in a word or two, for export.json. Throws IoError where a file would be lost, WriteError
/// where nothing can be written.
void write_export(const std::filesystem::path& folder, const std::string& what,
                  const std::map<std::string, std::string>& contents, Existing existing);

}  // namespace palpation::tool
