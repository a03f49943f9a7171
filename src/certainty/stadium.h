/// The places within a radius of a segment: what outlines' holes, notches and cores are taken for.
#pragma once

#include "palpation/base/types.h"

namespace palpation {

struct Stadium {
  double radius_m = 0.0;
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();  ///< of its segment

  /// Distance from its border, positive inside.
  double depth_at(const Vec2& place) const;
};

Stadium stadium_about(const Vec2& middle, double radius_m, double half_length_m, double angle);

}  // namespace palpation
