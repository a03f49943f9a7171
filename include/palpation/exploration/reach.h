/// What a probe on a shaft can touch: the tissue must face the shaft, and nothing may stand in the
/// way of the approach.
#pragma once

#include <optional>
#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

struct Access {
  /// From the tissue along the shaft, of any length: the probe comes against the normal, which must
  /// be within cone_rad of this. Nothing: any direction will do.
  std::optional<Vec3> shaft_direction{};
  double cone_rad = 1.0471975511965976;  ///< 60 degrees
  double clearance_m =
      0.0;  ///< as long a straight line along the normal must not meet the tissue again; 0: may
  double probe_radius_m =
      0.0;  ///< and so must a probe of this radius, with a round tip; only with a clearance
};

/// The vertices that can be touched, rising. Computes a search tree where there is a clearance.
/// Throws InvalidInput unless the direction is finite and not zero, the cone in (0, pi] and
/// clearance and radius finite and not negative.
std::vector<int> reachable_vertices(const Surface& surface, const Access& access);

}  // namespace palpation
