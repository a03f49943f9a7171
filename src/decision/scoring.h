/// A pointwise acquisition with its units frozen.
#pragma once

#include <cmath>
#include <span>

#include "palpation/decision/acquisition.h"

namespace palpation {

/// What touches are planned by: the variance of the whole field, but where it has a slope the mean
/// without it, since the level is of that. The variance without it is no measure of what a touch
/// would tell: constant and slope, which no touch tells apart alone, flood it.
Marginals planning_marginals(const Belief& belief);

class PointwiseScorer {
 public:
  /// Keeps a reference to the acquisition.
  PointwiseScorer(const Pointwise& acquisition, const Level& level, const Marginals& marginals,
                  std::span<const int> candidates);

  /// Throws InvalidInput if the score is NaN.
  double operator()(double mean, double variance) const {
    const double scaled_mean =
        is_scaled_ ? mean_origin_ + (mean - mean_origin_) / mean_unit_ : mean;
    const double result =
        acquisition_.score(scaled_mean, std::sqrt(variance) / stddev_unit_, level_);
    if (std::isnan(result)) refuse(mean, variance);
    return result;
  }

 private:
  static void refuse(double mean, double variance);

  const Pointwise& acquisition_;
  Level level_;
  bool is_scaled_;
  double stddev_unit_ = 1.0;
  double mean_origin_ = 0.0;
  double mean_unit_ = 1.0;
};

}  // namespace palpation
