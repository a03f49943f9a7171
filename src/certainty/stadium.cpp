#include "certainty/stadium.h"

#include <cmath>

#include "certainty/outline_nodes.h"

namespace palpation {

double Stadium::depth_at(const Vec2& place) const {
  return radius_m - std::sqrt(squared_distance(place, from, to));
}

Stadium stadium_about(const Vec2& middle, double radius_m, double half_length_m, double angle) {
  const Vec2 half = half_length_m * Vec2(std::cos(angle), std::sin(angle));
  return {radius_m, middle - half, middle + half};
}

}  // namespace palpation
