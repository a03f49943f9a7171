/// Fewer points where they lie close together: one for each group of neighbours.
#pragma once

#include <vector>

#include "palpation/base/types.h"

namespace palpation {

struct Thinned {
  Points points;           ///< the mean of each group
  std::vector<int> group;  ///< of each point that was given
  double radius_m = 0.0;   ///< of a group about its first point; 0: only equal points were joined
};

/// Joins equal points and, if more than `most` are left, covers them by balls, the least that are
/// at most so many: going through the points by x, then y, then z, each joins the nearest centre
/// within the radius or becomes one. So centres are at least a radius apart, and the order in which
/// the points are given does not matter. The radius is found to 10 %. Throws InvalidInput unless
/// coordinates are finite and most is at least 1.
Thinned thin(const Points& points, int most);

}  // namespace palpation
