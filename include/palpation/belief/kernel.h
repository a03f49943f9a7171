/// Covariance functions of the field (Rasmussen and Williams 2006, chapter 4), as functions of the
/// difference of two places.
#pragma once

#include "palpation/base/types.h"

namespace palpation {

enum class KernelFamily { SquaredExponential, Matern12, Matern32, Matern52, Periodic };

struct Kernel {
  KernelFamily family = KernelFamily::SquaredExponential;
  double length_m = 0.0033;
  double signal_sd = 1.0;  ///< prior standard deviation of the field, in reading units (or in the
                           ///< readings' own spread: see BeliefOptions)
  double period_m = 0.0;   ///< of the periodic kernel, the same along both axes of the chart
};

/// Throws InvalidInput unless length and signal (and the period, where there is one) are positive
/// and finite, and the signal's standard deviation is from 1e-150 to 1e150: its square must be a
/// number.
void check(const Kernel& kernel);

/// Correlation of the field at two places `difference` apart, in [0, 1]; 1 at zero. With r =
/// |difference| / length:
///   squared exponential exp(-r^2/2);  Matern 1/2 exp(-r);  3/2 (1 + s) exp(-s), s = sqrt(3) r; 5/2
///   (1 + s + s^2/3) exp(-s), s = sqrt(5) r; periodic: the squared exponential of the chord
///   (period/pi) sin(pi d / period) in place of each coordinate d, a product over u and v.
double correlation(const Kernel& kernel, const Vec3& difference);

/// 1 - correlation to the last digits, however small it is.
double decorrelation(const Kernel& kernel, const Vec3& difference);

/// correlation(difference + step) - correlation(difference), to the last digits of the step.
double correlation_change(const Kernel& kernel, const Vec3& difference, const Vec3& step);

/// d correlation / d log(length).
double correlation_slope(const Kernel& kernel, const Vec3& difference);

}  // namespace palpation
