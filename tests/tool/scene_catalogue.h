/// Scenes that could do harm, and what must come of each: the rows C01 to C19 of the catalogue of
/// bad configurations.
///
/// Free of any test framework, so that the texts also serve as seeds for a fuzzer.
#pragma once

#include <string>
#include <vector>

namespace palpation::catalogue {

struct SceneCase {
  std::string row;   ///< "C01" to "C19"
  std::string name;  ///< what is odd about it
  std::string text;  ///< the bytes of the scene's file
  std::vector<std::string>
      refused_with{};  ///< what the error says, behind the file's name; empty: the scene runs
  std::vector<std::string> overrides{};    ///< as given by --set
  std::vector<std::string> warned_with{};  ///< what the warnings of a scene that runs say, one each
};

const std::vector<SceneCase>& scene_cases();

/// Files that the scenes name, beside them.
struct SceneFile {
  std::string name, content;
};
const std::vector<SceneFile>& scene_files();

/// A row that no scene can show, and what takes its place.
struct RowElsewhere {
  std::string row, reason;
};
const std::vector<RowElsewhere>& scene_rows_elsewhere();

}  // namespace palpation::catalogue
