/// The one place that a search for a shortest path aims at, and the best way to it so far.
#pragma once

#include <algorithm>
#include <limits>

#include "geometry/window.h"
#include "palpation/geometry/surface.h"

namespace palpation {

class LightTarget {
 public:
  /// Only ways no longer than at_most_m count.
  LightTarget(const SurfacePoint& where, const Vec3& place, double at_most_m)
      : where_(where), place_(place), at_most_m_(at_most_m) {}

  int face() const { return where_.face; }
  const Vec3& barycentric() const { return where_.barycentric; }
  const Vec3& place() const { return place_; }
  const Reached& reached() const { return reached_; }

  /// Longer ways than this cannot be the shortest.
  double longest() const {
    return std::min(at_most_m_, reached_.is_known ? reached_.distance
                                                  : std::numeric_limits<double>::infinity()) *
           (1.0 + kEqualWays);
  }
  /// Whether light that has come so far cannot be the first to reach it.
  bool is_behind(double distance) const {
    return reached_.is_known && distance >= reached_.distance;
  }
  /// Takes a way to it, if it is the shortest so far.
  void reach(double distance, int window, int origin, int face) {
    if (distance > at_most_m_ * (1.0 + kEqualWays) || is_behind(distance)) return;
    reached_ = {true, distance, window, origin, face, 0.0};
  }

 private:
  SurfacePoint where_;
  Vec3 place_;
  double at_most_m_;
  Reached reached_{};
};

}  // namespace palpation
