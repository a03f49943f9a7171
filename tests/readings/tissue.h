/// Small tissues and readings for tests of what is made of them.
#pragma once

#include <cmath>
#include <vector>

#include "palpation/base/random.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/geometry/surface.h"
#include "palpation/readings/palpation.h"

namespace palpation {

inline Surface plane(int columns, int rows, double jitter = 0.0) {
  Random random(7);
  return Surface(make_plane({.columns = columns, .rows = rows, .jitter = jitter}, random));
}

inline Palpation touch(const Surface& surface, int vertex, double reading) {
  Palpation palpation;
  palpation.where = surface.at_vertex(vertex);
  palpation.reading = reading;
  return palpation;
}

/// `count` readings at distinct vertices: a smooth bump and noise.
inline std::vector<Palpation> bumpy_readings(const Surface& surface, int count, Random& random) {
  std::vector<Palpation> palpations;
  std::vector<bool> taken(static_cast<std::size_t>(surface.vertex_count()), false);
  while (static_cast<int>(palpations.size()) < count) {
    const int vertex = random.below(surface.vertex_count());
    if (taken[vertex]) continue;
    taken[vertex] = true;
    const Vec3 p = surface.vertex(vertex) - Vec3(0.0115, 0.030, 0.0);
    palpations.push_back(touch(
        surface, vertex,
        7.0 + 2.0 / (1.0 + std::exp(1400.0 * (p.norm() - 0.00625))) + 0.05 * random.normal()));
  }
  return palpations;
}

}  // namespace palpation
