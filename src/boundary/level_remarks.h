/// What a person should know of a level set before trusting its boundary. Nothing of this changes a
/// result.
#pragma once

#include <string>
#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

struct LevelRemarks {
  int small_loops = 0;    ///< loops shorter than the way around each triangle that they pass: finer
                          ///< than what the mesh can show
  int bare_vertices = 0;  ///< vertices at the level with nothing inside around them: peaks and
                          ///< ridges that only just reach it

  std::vector<std::string> words() const;  ///< a sentence for each kind that there is
};

/// Throws as level_loops.
LevelRemarks remarks_on_level_set(const Surface& surface, const Field& field, double level);

}  // namespace palpation
