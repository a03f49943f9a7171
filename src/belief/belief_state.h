/// All that a belief is: its prior, the readings, the engine that has taken them in, and the
/// constant and the slope that they leave.
#pragma once

#include <memory>
#include <vector>

#include "belief/exact_engine.h"
#include "belief/reduced_engine.h"

namespace palpation {

struct BeliefState {
  ScaledPrior field;
  std::vector<Palpation> palpations{};
  ExactEngine exact{};                             // without a site where there is
  std::shared_ptr<const ReducedEngine> reduced{};  // one of reduced rank
  int reduction_tried_at = 0;                      // sites, in vain
  Regression regression{field, exact.whitened()};

  const Engine& engine() const { return reduced ? static_cast<const Engine&>(*reduced) : exact; }
  double residual_ones(int vertex) const {
    return engine().residual_ones(field.prior.tiles(), vertex);
  }
  /// Regression::tilt_residual at a vertex.
  Vec3 tilt_residual(int vertex, Part part = Part::Whole) const;
};

}  // namespace palpation
