/// Posterior covariance of the field between one vertex and others: the row that a hypothetical
/// touch there would add.
#pragma once

#include <memory>
#include <vector>

#include "palpation/belief/belief.h"

namespace palpation {

class TileCorrelations;

class CovarianceWith {
 public:
  /// Keeps a reference: the belief must outlive it.
  CovarianceWith(const Belief& belief, int vertex);

  /// With `count` consecutive vertices from `first` on, written to `out`.
  void operator()(int first, int count, double* out) const;

 private:
  const BeliefState& state_;
  int vertex_;
  std::shared_ptr<const TileCorrelations> correlations_;
  std::vector<double> column_;  // of the engine's rows
  double residual_ones_;
  Vec3 tilt_weights_ = Vec3::Zero();  // of the slope's residual at the other vertex
};

}  // namespace palpation
