/// What the readings tell of one place, before the constant and the slope are counted.
#pragma once

#include "palpation/belief/belief.h"

namespace palpation {

struct Belief::Seen {
  double unexplained = 1.0;  // 1 - v'v, v = L^-1 k
  double ones = 0.0;         // v' L^-1 1
  double whitened = 0.0;     // v' L^-1 (y - origin)
  Vec3 tilts = Vec3::Zero();
};

}  // namespace palpation
