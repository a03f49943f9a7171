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

/// Mean square of an amplitude's error, from the frequencies beside the oscillation.
double error_beside(const Eigen::VectorXd& time_s, const Eigen::VectorXd& force_left,
                    const Eigen::VectorXd& position_left, Complex ratio, double frequency_hz,
                    int periods);

}  // namespace palpation
