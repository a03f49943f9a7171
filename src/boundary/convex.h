/// Convex polygons cut by half-planes. Private to this folder.
#pragma once

#include <array>

#include "palpation/base/types.h"

namespace palpation {

/// A convex polygon that half-planes cut smaller: a triangle cut three times has at most six
/// corners.
class Convex {
 public:
  Convex(const Vec2& a, const Vec2& b, const Vec2& c) : corners_{a, b, c}, count_(3) {}

  /// Keeps what is at least 0 for a linear function (Sutherland and Hodgman 1974).
  template <typename Linear>
  void cut(const Linear& inside) {
    std::array<Vec2, 8> kept;
    int number = 0;
    for (int i = 0; i < count_; ++i) {
      const Vec2 &here = corners_[i], &next = corners_[(i + 1) % count_];
      const double at_here = inside(here), at_next = inside(next);
      if (at_here >= 0.0) kept[number++] = here;
      if ((at_here > 0.0 && at_next < 0.0) || (at_here < 0.0 && at_next > 0.0))
        kept[number++] = here + at_here / (at_here - at_next) * (next - here);
    }
    corners_ = kept;
    count_ = number;
  }

  double area() const {
    double twice = 0.0;
    for (int i = 2; i < count_; ++i)
      twice += twice_area(corners_[i - 1] - corners_[0], corners_[i] - corners_[0]);
    return 0.5 * twice;
  }

 private:
  static double twice_area(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

  std::array<Vec2, 8> corners_;
  int count_;
};

}  // namespace palpation
