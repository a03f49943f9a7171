#include "io/places.h"

#include <algorithm>
#include <cmath>

namespace palpation {
namespace {

/// Large enough that a point seldom reaches into a second cell, small enough that a cell holds few
/// places.
constexpr double kCell_m = 10.0 * kSamePlace_m;

std::array<double, 3> cell_of(const Vec3& position) {
  return {std::floor(position.x() / kCell_m), std::floor(position.y() / kCell_m),
          std::floor(position.z() / kCell_m)};
}

}  // namespace

std::size_t Places::number_of(const SurfacePoint& where, const Vec3& position) {
  const std::array<double, 3> low = cell_of(position.array() - kSamePlace_m),
                              high = cell_of(position.array() + kSamePlace_m);
  std::size_t number = places_.size();
  for (int corner = 0; corner < 8; ++corner) {
    std::array<double, 3> cell{};
    bool seen = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool is_high = (corner >> axis & 1) != 0;
      seen = seen || (is_high && high[axis] == low[axis]);
      cell[axis] = is_high ? high[axis] : low[axis];
    }
    if (seen) continue;
    const auto [first, last] = at_cell_.equal_range(cell);
    for (auto entry = first; entry != last; ++entry) {
      if ((places_[entry->second].position - position).norm() <= kSamePlace_m)
        number = std::min(number, entry->second);
    }
  }
  if (number == places_.size()) {
    places_.push_back({where, position});
    at_cell_.emplace(cell_of(position), number);
  }
  return number;
}

}  // namespace palpation
