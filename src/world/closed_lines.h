/// Closed polygonal lines in a plane, and the area between them by the even-odd rule.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "geometry/nearest_segment.h"
#include "palpation/base/types.h"

namespace palpation {

class ClosedLines {
 public:
  /// Each line through at least three points, and back to its first.
  explicit ClosedLines(std::vector<std::vector<Vec2>> lines);

  /// To the nearest of the lines, positive inside.
  double signed_distance(const Vec2& place) const;

 private:
  std::vector<Segment<2>> segments_;
};

/// Two sides of a closed line (side i begins at point i) that meet elsewhere than at the point
/// which neighbours share.
std::optional<std::pair<int, int>> sides_that_meet(const std::vector<Vec2>& line);

}  // namespace palpation
