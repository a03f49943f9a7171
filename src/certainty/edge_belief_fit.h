/// What an EdgeBelief keeps: the fit, and how readings and depths elsewhere go with it.
#pragma once

#include <vector>

#include "certainty/edge_fit.h"
#include "palpation/certainty/edge_belief.h"

namespace palpation {

struct EdgeBelief::Fit {
  Prior correction;
  ProfilePrior prior;
  double fraction;
  double touch_variance;  ///< noise of a reading to come
  EdgeData data;
  EdgeFit edge;
  Field distance_m;       ///< of each vertex from the first boundary, signed
  std::vector<int> part;  ///< that each vertex is nearest to
  double log_evidence;    ///< by the field's noise; that by its own is the edge's
  double weight = 1.0;    ///< posterior probability of its kind of outline and its explanation
  double alike = 1.0;     ///< of its explanation, over its kinds of outline
  Field depth{};          ///< at the vertices

  /// Of the boundary below the middle of the profile: logit(fraction) / slope.
  double shift_m() const;
  /// Posterior covariance of the profile's parameters.
  Eigen::MatrixXd profile_covariance() const;
  EdgeProfile edge_profile() const;
  Field depth_at_vertices() const;

  /// Prior covariance of the readings (rows) with depths at points (columns): what both share is
  /// the correction, and the slope by the shift.
  Eigen::MatrixXd readings_with_depths(std::span<const SurfacePoint> points) const;
  /// Posterior covariance of the depths at points.
  Eigen::MatrixXd depth_covariance(std::span<const SurfacePoint> points) const;
};

}  // namespace palpation
