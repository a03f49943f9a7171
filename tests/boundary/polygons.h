/// Rings, regions and refusals for the tests of this folder.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "palpation/base/error.h"
#include "palpation/base/random.h"
#include "palpation/boundary/region.h"

namespace palpation::testing {

inline Ring box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

inline Ring reversed(const Ring& ring) { return {ring.rbegin(), ring.rend()}; }

inline Region region_of(Ring outer, std::vector<Ring> holes = {}) {
  const std::array polygon{PolygonWithHoles{std::move(outer), std::move(holes)}};
  return Region(polygon);
}

inline Region even_odd(const std::vector<Ring>& rings) { return Region::even_odd(rings); }

inline bool same(const Region& a, const Region& b) { return symmetric_difference(a, b).empty(); }

/// What is thrown as InvalidInput, or nothing.
template <typename Work>
std::string refusal(Work work) {
  try {
    work();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Corners on a coarse lattice: edges overlap, corners coincide and points repeat all the time.
inline Ring lattice_ring(Random& random, int corners, int side) {
  Ring ring;
  for (int i = 0; i < corners; ++i) ring.emplace_back(random.below(side), random.below(side));
  return ring;
}

/// Seen whole from its centre, so it never crosses itself.
/// The less rough, the fewer crossings with another one.
inline Ring star(Random& random, const Vec2& centre, double radius, int corners,
                 double roughness = 0.6) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.8 * random.uniform()) / corners;
    ring.push_back(centre + radius * (1.0 - roughness * random.uniform()) *
                                Vec2(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

/// Spikes of a wheel, all bent one way or all the other.
inline Ring pinwheel(int spikes, double bend) {
  Ring ring;
  for (int i = 0; i < spikes; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / spikes;
    ring.emplace_back(0.5 * std::cos(angle), 0.5 * std::sin(angle));
    ring.emplace_back(std::cos(angle + bend), std::sin(angle + bend));
  }
  return ring;
}

}  // namespace palpation::testing
