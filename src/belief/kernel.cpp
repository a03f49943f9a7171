#include "palpation/belief/kernel.h"

#include <cmath>
#include <numbers>

#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kPi = std::numbers::pi;

/// (d/l)^2 and not d^2/l^2, which is NaN at d = 0 for tiny lengths.
double squared_ratio(const Kernel& kernel, const Vec3& difference) {
  if (kernel.family != KernelFamily::Periodic) return (difference / kernel.length_m).squaredNorm();
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double chord = kernel.period_m / kPi * std::sin(kPi * difference[axis] / kernel.period_m);
    sum += (chord / kernel.length_m) * (chord / kernel.length_m);
  }
  return sum;
}

bool positive_and_finite(double value) { return std::isfinite(value) && value > 0.0; }

}  // namespace

void check(const Kernel& kernel) {
  require(positive_and_finite(kernel.length_m), "Kernel", "length_m = " + text_of(kernel.length_m), "must be positive and finite");
  require(positive_and_finite(kernel.signal_sd), "Kernel", "signal_sd = " + text_of(kernel.signal_sd), "must be positive and finite");
  if (kernel.family == KernelFamily::Periodic) {
    require(positive_and_finite(kernel.period_m), "Kernel", "period_m = " + text_of(kernel.period_m), "must be positive and finite");
  }
}

double correlation(const Kernel& kernel, const Vec3& difference) {
  const double r2 = squared_ratio(kernel, difference);
  switch (kernel.family) {
    case KernelFamily::SquaredExponential:
    case KernelFamily::Periodic:
      return std::exp(-0.5 * r2);
    case KernelFamily::Matern12:
      return std::exp(-std::sqrt(r2));
    case KernelFamily::Matern32: {
      const double s = std::sqrt(3.0 * r2);
      return std::isfinite(s) ? (1.0 + s) * std::exp(-s) : 0.0;
    }
    case KernelFamily::Matern52: {
      const double s = std::sqrt(5.0 * r2);
      return std::isfinite(s) ? (1.0 + s + s * s / 3.0) * std::exp(-s) : 0.0;
    }
  }
  return 0.0;
}

double correlation_slope(const Kernel& kernel, const Vec3& difference) {
  const double r2 = squared_ratio(kernel, difference);
  if (!std::isfinite(r2)) return 0.0;
  switch (kernel.family) {
    case KernelFamily::SquaredExponential:
    case KernelFamily::Periodic:
      return r2 * std::exp(-0.5 * r2);
    case KernelFamily::Matern12:
      return std::sqrt(r2) * std::exp(-std::sqrt(r2));
    case KernelFamily::Matern32:
      return 3.0 * r2 * std::exp(-std::sqrt(3.0 * r2));
    case KernelFamily::Matern52: {
      const double s = std::sqrt(5.0 * r2);
      return s * s * (1.0 + s) / 3.0 * std::exp(-s);
    }
  }
  return 0.0;
}

}  // namespace palpation
