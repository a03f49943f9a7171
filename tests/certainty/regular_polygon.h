// Outlines that are as even as can be.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "certainty/outline_nodes.h"

namespace palpation {

/// Around the origin, counter-clockwise.
inline OutlineNodes regular_polygon(int nodes, double radius_m) {
  std::vector<Vec2> line;
  for (int i = 0; i < nodes; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / nodes;
    line.push_back(radius_m * Vec2(std::cos(angle), std::sin(angle)));
  }
  OutlineNodes outline;
  outline.add(line, 0);
  return outline;
}

}  // namespace palpation
