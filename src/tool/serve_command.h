/// serve: a session and its gate for callers in any language.
#pragma once

#include <filesystem>

namespace palpation::tool {

/// Lines from standard input, answers to standard output, until the end of the input. What came at
/// once is synced at once, before any of it is answered.
void serve(const std::filesystem::path& folder);

}  // namespace palpation::tool
