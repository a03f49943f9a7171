/// Healthy tissue that rises and falls slowly over the surface: a Gaussian field of few terms.
///
/// Its covariance is Matern's (5/2), by the pivoted Cholesky decomposition at the readings
/// (Harbrecht, Peters and Schneider 2012): the terms at the other places are what the pivots tell
/// of them, so that they are the same however tissue is turned.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "palpation/belief/prior.h"

namespace palpation {

/// From twice the width of a tumour of 4 cm2 to more than tissue is wide: shorter ones pass for
/// tumours, longer ones are slopes.
inline constexpr std::array kSlowLengths_m = {0.04, 0.07};

class SlowWaves {
 public:
  /// At these places, of which there is one at least. Throws as Prior does.
  SlowWaves(Surface surface, Metric metric, double length_m, std::span<const SurfacePoint> places);

  /// What one unit of each coefficient adds to each place: rows are places, columns terms. The
  /// coefficients are standard normal beforehand, for waves of height one.
  const Eigen::MatrixXd& terms() const { return terms_; }
  /// Waves of these coefficients.
  Field at_vertices(const Eigen::VectorXd& coefficients) const;

 private:
  Prior prior_;
  std::vector<SurfacePoint> pivots_;
  Eigen::MatrixXd terms_;
  Eigen::MatrixXd of_pivots_;  ///< the pivots' rows of them, lower triangular
};

}  // namespace palpation
