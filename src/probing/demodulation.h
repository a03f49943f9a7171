/// The oscillation in a window of samples: amplitudes by harmonic, without drift and travel.
#pragma once

#include <Eigen/QR>
#include <complex>

#include "palpation/base/types.h"

namespace palpation {

using Complex = std::complex<double>;

inline constexpr Eigen::Index kHarmonics = 3;
inline constexpr Eigen::Index kDrift = 4;  ///< a cubic's coefficients

/// Complex amplitudes by harmonic, a row each, and what is left.
struct Demodulated {
  Eigen::MatrixXcd amplitudes;
  Eigen::MatrixXd left;
};

/// Drift in its first columns, then cosine and sine of each harmonic.
Eigen::MatrixXd basis_of(const Eigen::VectorXd& time_s, double frequency_hz, double half_s);

Demodulated demodulate(const Eigen::HouseholderQR<Eigen::MatrixXd>& solver,
                       const Eigen::MatrixXd& basis, const Eigen::MatrixXd& columns);

/// The noise of an amplitude, from the frequencies beside the oscillation: of noise as strong
/// there, less what the basis takes of it.
class Beside {
 public:
  /// Of as many neighbours to either side as half the periods of a window.
  Beside(const Eigen::VectorXd& time_s, const Eigen::HouseholderQR<Eigen::MatrixXd>& solver,
         const Eigen::MatrixXd& basis, double frequency_hz, int periods);

  /// Mean square of the error of a force's amplitude less a ratio times the position's, by what is
  /// left of both.
  double error(const Eigen::VectorXd& force_left, const Eigen::VectorXd& position_left,
               Complex ratio) const;

 private:
  Eigen::MatrixXcd waves_;  ///< a column each
  Eigen::VectorXd left_;    ///< of white noise at each: the part that the basis leaves
  double own_ = 1.0;        ///< an amplitude's variance over that of one without a basis
};

}  // namespace palpation
