/// A function known at scattered points of the plane, linear between them.
#pragma once

#include <memory>
#include <optional>

#include "palpation/base/types.h"

namespace palpation {

/// The piecewise linear interpolant over the Delaunay triangulation of the points. Points with
/// equal coordinates are merged, their values averaged. Immutable; copies share. Safe to evaluate
/// from several threads.
class ScatteredField {
 public:
  /// points n x 2, values n. Throws InvalidInput unless sizes agree, all are finite, and at least
  /// three points are not on one line.
  ScatteredField(const Points2& points, const Eigen::VectorXd& values);

  /// The value at a place; nothing outside the convex hull or farther than reach_m from every
  /// point. Throws InvalidInput if the place is not finite or reach_m negative.
  std::optional<double> at(const Vec2& place, double reach_m) const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace palpation
