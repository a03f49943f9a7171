/// What Region's constructor tidies away without a word, counted, for those who want to tell the
/// person that drew the outline.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "palpation/boundary/region.h"

namespace palpation {

struct OutlineRepairs {
  int repeated_corners =
      0;  ///< corners where the ring already was; a first corner given again at the end is one
  int spike_corners = 0;  ///< corners of spikes, where a ring turns back upon itself, there and
                          ///< back without any width
  int rings_without_area =
      0;  ///< rings of which nothing is left: all corners in one place or on one line

  std::vector<std::string> words() const;  ///< a sentence for each kind that there is
};

/// Throws InvalidInput as Region does of single coordinates; crossings and overlaps are not looked
/// for.
OutlineRepairs repairs_of(std::span<const PolygonWithHoles> polygons);

}  // namespace palpation
