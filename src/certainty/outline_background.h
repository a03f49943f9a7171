/// What healthy tissue and the sensor add to readings beside a plateau: waves over the tissue, a
/// zero that drifts from batch to batch, a tilt of the tissue or of its stiffness, and what is left
/// of the zero's steps once they are taken back.
///
/// The waves are a Gaussian field, by the pivoted Cholesky decomposition of its covariance at the
/// readings (Harbrecht, Peters and Schneider 2012), so that they are the same however tissue is
/// turned: of a length as short as what a tip can feel, and of one longer than an edge; how high
/// each are is learned, and whether there are any: half of the tissues have none of a kind, and
/// half no drift, and half no tilt. Slow ones, and errors that last over some readings, are there
/// where they were seen, and have the height that was. All is linear in coefficients that are
/// normal, and can be integrated out (outline_residuals.h).
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "palpation/base/types.h"

namespace palpation {

/// Columns of waves of one length, or of lasting errors: longer ones need fewer.
inline constexpr Eigen::Index kMostOfOneKind = 128;

/// What one unit of each coefficient adds to each reading: rows are readings, columns terms. First
/// the waves of each length; then the drift, one unit from the first batch to the last; then the
/// tilt along x and y, one unit over the readings' root mean square distance from their middle;
/// then what was seen; then the steps.
struct BackgroundTerms {
  Eigen::MatrixXd of_readings;
  std::vector<Eigen::Index> waves;  ///< columns of each length, the shortest first
  double median_sd = 1.0;   ///< of waves of one length beforehand, in reading units; the spread of
                            ///< its logarithm is 1
  double drift_sd = 1.0;    ///< in reading units
  double tilt_sd = 1.0;     ///< of either direction, in reading units
  Eigen::Index seen = 0;    ///< columns of slow waves and lasting errors; in reading units
  Eigen::VectorXd step_sd;  ///< of each, in reading units

  Eigen::Index steps() const { return step_sd.size(); }

  bool is_none() const { return of_readings.size() == 0; }
};
/// Of what readings are off by, background and noise.
struct ResidualScales {
  double log_noise = 0.0;        ///< beside a tumour
  std::vector<double> log_sd{};  ///< of the waves of each length, over its median
  double wild = 0.0;             ///< part of the readings that tell nothing
  double growth = 0.0;           ///< logarithm: the noise on a plateau over that beside it
  /// Whether there are waves of each length; and a drift, and a tilt.
  std::vector<bool> has{};
};

struct BackgroundReadings {
  std::span<const Vec2> places;
  std::span<const double> when;  ///< any numbers that rise as time goes on
  Eigen::MatrixXd seen{};        ///< slow waves, lasting errors: what one sd of each adds to each
                                 ///< reading: as many rows, or none
  Eigen::MatrixXd steps{};  ///< what one unit of each adds to each reading: as many rows, or none
};
BackgroundTerms background_terms(const BackgroundReadings& readings);
/// That readings of such variances have of the coefficients: F' V^-1 F.
Eigen::MatrixXd information_of(const BackgroundTerms& terms, std::span<const double> variance);

}  // namespace palpation
