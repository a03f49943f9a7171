/// Hostile and odd mesh files, row by row of the catalogue M01 to M46, and what reading each must
/// give.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace palpation::catalogue {

/// The file is an error. The message is the path, `place` (":7", ", byte 80", or nothing where the
/// file as a whole is at fault), ": ", and words in which all `parts` occur: the element, the value
/// and the rule.
struct Refused {
  std::string place;
  std::vector<std::string> parts;
};

/// The file is a mesh. In each of its warnings one of these parts occurs, and each part in one of
/// them.
struct Accepted {
  int vertices, faces;
  std::vector<std::string> warnings = {};
};

/// The file is a mesh but no surface: the message names the element and what it breaks.
struct NoSurface {
  int vertices, faces;
  std::vector<std::string> parts;
  std::vector<std::string> warnings = {};
};

struct MeshCase {
  std::string row;   ///< "M07"
  std::string name;  ///< what is special, in a few words
  std::string file;  ///< the name to give it
  std::string bytes;
  std::variant<Refused, Accepted, NoSurface> expected;
};

const std::vector<MeshCase>& mesh_cases();

}  // namespace palpation::catalogue
