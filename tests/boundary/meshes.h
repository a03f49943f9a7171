/// Small surfaces and fields for the tests of this folder.
#pragma once

#include <cmath>
#include <numbers>

#include "palpation/base/random.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/geometry/surface.h"

namespace palpation::testing {

/// The unit square in z = 0.
inline Surface unit_square(int cells_per_side, double jitter = 0.0, std::uint64_t seed = 1) {
  Random random(seed);
  return Surface(make_plane(
      {.size_m = {1.0, 1.0}, .columns = cells_per_side + 1, .rows = cells_per_side + 1, .corner_m = {0.0, 0.0}, .jitter = jitter}, random));
}

template <typename Function>
Field field_of(const Surface& surface, Function function) {
  Field field(surface.vertex_count());
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) field[vertex] = function(surface.vertex(vertex));
  return field;
}

/// A few waves in random directions.
inline Field smooth_field(const Surface& surface, Random& random) {
  Field field = Field::Zero(surface.vertex_count());
  for (int wave = 0; wave < 5; ++wave) {
    const Vec3 direction(4.0 * random.normal(), 4.0 * random.normal(), 0.0);
    const double phase = 2.0 * std::numbers::pi * random.uniform();
    field += field_of(surface, [&](const Vec3& p) { return std::sin(direction.dot(p) + phase); });
  }
  return field;
}

/// Every vertex for itself: loops in nearly every triangle, and many at the border.
inline Field rough_field(const Surface& surface, Random& random) {
  return field_of(surface, [&](const Vec3&) { return random.normal(); });
}

/// Whole numbers from 0 to 2, so that with level 1 a third of the vertices is exactly at the level: plateaus, ridges, saddles.
inline Field stepped_field(const Surface& surface, Random& random) {
  return field_of(surface, [&](const Vec3&) { return static_cast<double>(random.below(3)); });
}

}  // namespace palpation::testing
