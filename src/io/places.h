/// Places on a surface, each known by the first point that came within a nanometre: what counts as
/// touching the same spot again.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "palpation/geometry/surface_point.h"

namespace palpation {

inline constexpr double kSamePlace_m = 1e-9;

class Places {
 public:
  struct Place {
    SurfacePoint where;
    Vec3 position = Vec3::Zero();
  };

  /// The number of the place of a point: the earliest within reach, or a new one.
  std::size_t number_of(const SurfacePoint& where, const Vec3& position);
  const Place& operator[](std::size_t number) const { return places_[number]; }
  std::size_t size() const { return places_.size(); }

 private:
  std::vector<Place> places_;
  std::multimap<std::array<double, 3>, std::size_t> at_cell_;
};

}  // namespace palpation
