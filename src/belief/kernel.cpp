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

/// squared_ratio(difference + step) - squared_ratio(difference), by products that keep the digits
/// of a small step.
double ratio_change(const Kernel& kernel, const Vec3& difference, const Vec3& step) {
  if (kernel.family != KernelFamily::Periodic)
    return (step / kernel.length_m).dot((2.0 * difference + step) / kernel.length_m);
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double chord = kernel.period_m / kPi / kernel.length_m;
    sum += chord * std::sin(kPi * step[axis] / kernel.period_m) *
           (chord * std::sin(kPi * (2.0 * difference[axis] + step[axis]) / kernel.period_m));
  }
  return sum;
}

/// sum of s^k / k! from k = 3 on: e^s - 1 - s - s^2/2, all terms positive.
double exponential_tail(double s) {
  double sum = 0.0;
  double term = s * s * s / 6.0;
  for (int k = 4; term > 1e-18 * sum; ++k) {
    sum += term;
    term *= s / k;
  }
  return sum;
}

/// Of a Matern kernel: s in its exponent, for r^2.
double matern_s(KernelFamily family, double r2) {
  return family == KernelFamily::Matern12
             ? std::sqrt(r2)
             : std::sqrt((family == KernelFamily::Matern32 ? 3.0 : 5.0) * r2);
}

/// And the polynomial before it, less 1.
double matern_rise(KernelFamily family, double s) {
  if (family == KernelFamily::Matern12) return 0.0;
  return family == KernelFamily::Matern32 ? s : s + s * s / 3.0;
}

bool positive_and_finite(double value) { return std::isfinite(value) && value > 0.0; }

}  // namespace

void check(const Kernel& kernel) {
  require(positive_and_finite(kernel.length_m), "Kernel", "length_m = " + text_of(kernel.length_m),
          "must be positive and finite");
  require(positive_and_finite(kernel.signal_sd), "Kernel",
          "signal_sd = " + text_of(kernel.signal_sd), "must be positive and finite");
  require(kernel.signal_sd >= 1e-150 && kernel.signal_sd <= 1e150, "Kernel",
          "signal_sd = " + text_of(kernel.signal_sd),
          "must be from 1e-150 to 1e150, so that its square is a number");
  if (kernel.family == KernelFamily::Periodic) {
    require(positive_and_finite(kernel.period_m), "Kernel",
            "period_m = " + text_of(kernel.period_m), "must be positive and finite");
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

double decorrelation(const Kernel& kernel, const Vec3& difference) {
  const double r2 = squared_ratio(kernel, difference);
  if (kernel.family == KernelFamily::SquaredExponential || kernel.family == KernelFamily::Periodic)
    return -std::expm1(-0.5 * r2);
  const double s = matern_s(kernel.family, r2);
  if (kernel.family == KernelFamily::Matern12) return -std::expm1(-s);
  if (s > 1.0) return 1.0 - correlation(kernel, difference);
  // e^-s (e^s - 1 - s - ...): what is left of the exponential series.
  const double square = s * s * (kernel.family == KernelFamily::Matern32 ? 1.0 / 2.0 : 1.0 / 6.0);
  return std::exp(-s) * (square + exponential_tail(s));
}

double correlation_change(const Kernel& kernel, const Vec3& difference, const Vec3& step) {
  if (difference.isZero(0.0)) return -decorrelation(kernel, step);
  const double change = ratio_change(kernel, difference, step);
  if (kernel.family == KernelFamily::SquaredExponential || kernel.family == KernelFamily::Periodic)
    return correlation(kernel, difference) * std::expm1(-0.5 * change);
  const double s = matern_s(kernel.family, squared_ratio(kernel, difference));
  const double moved = matern_s(kernel.family, squared_ratio(kernel, difference + step));
  if (!std::isfinite(s) || !std::isfinite(moved) || s + moved == 0.0)
    return correlation(kernel, difference + step) - correlation(kernel, difference);
  const double factor = kernel.family == KernelFamily::Matern12   ? 1.0
                        : kernel.family == KernelFamily::Matern32 ? 3.0
                                                                  : 5.0;
  const double ds = factor * change / (s + moved);
  const double rise = kernel.family == KernelFamily::Matern12   ? 0.0
                      : kernel.family == KernelFamily::Matern32 ? ds
                                                                : ds + ds * (s + moved) / 3.0;
  return std::exp(-s) * ((1.0 + matern_rise(kernel.family, moved)) * std::expm1(-ds) + rise);
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
