/// What a file says of a boundary, and what was done to it on the way.
#pragma once

#include <string>
#include <vector>

#include "palpation/boundary/region.h"

namespace palpation {

struct BoundaryFile {
  Region region;
  std::vector<std::string>
      warnings;  ///< plain sentences: points moved to the surface, corners tidied away
};

}  // namespace palpation
