/// Closed curves of tumours, of any size and anywhere: counter-clockwise, the last point joined to
/// the first. Empty where a draw crosses itself.
#pragma once

#include <vector>

#include "palpation/base/random.h"
#include "palpation/world/random_shape.h"

namespace palpation {

using Curve = std::vector<Vec2>;

Curve draw_curve(ShapeFamily family, Random& random);

/// Uniform between two values.
inline double uniform(Random& random, double least, double most) {
  return least + (most - least) * random.uniform();
}

}  // namespace palpation
