#include "belief/intrinsic.h"

#include <cmath>
#include <numbers>

namespace palpation {
namespace {

constexpr double kLoss =
    1e-4;  // of the variance, in the modes left out: squared exponential of the one length
constexpr double kLossAtLeast = 1e-2;  // and at the least length of a range
// The Materns of one length, and at the least length of a range; at the median of a range they lose
// as much as with one length.
constexpr double kMatern52Loss = 1e-2, kMatern52LossAtLeast = 7e-2;
constexpr double kMatern32Loss = 4e-2, kMatern32LossAtLeast = 0.15;
constexpr double kMargin = 1.75;  // lengths; a range's most lengths have one

double smoothness(KernelFamily family) { return family == KernelFamily::Matern32 ? 1.5 : 2.5; }

/// length^2 lambda where the modes left out hold that part of the variance in the plane.
double end_of_spectrum(KernelFamily family, bool one_length) {
  if (family == KernelFamily::SquaredExponential)
    return -2.0 * std::log(one_length ? kLoss : kLossAtLeast);
  const double nu = smoothness(family);
  const double loss = family == KernelFamily::Matern32
                          ? (one_length ? kMatern32Loss : kMatern32LossAtLeast)
                          : (one_length ? kMatern52Loss : kMatern52LossAtLeast);
  return 2.0 * nu * (std::pow(loss, -1.0 / nu) - 1.0);
}

}  // namespace

bool has_spectral_form(KernelFamily family) {
  return family == KernelFamily::SquaredExponential || family == KernelFamily::Matern32 ||
         family == KernelFamily::Matern52;
}

Eigen::VectorXd spectral_weights(const Kernel& kernel, const Eigen::VectorXd& eigenvalues) {
  const Eigen::ArrayXd x = eigenvalues.array() * kernel.length_m * kernel.length_m;
  if (kernel.family == KernelFamily::SquaredExponential) return (-0.5 * x).exp();
  const double nu = smoothness(kernel.family);
  return (1.0 + x / (2.0 * nu)).pow(-(nu + 1.0));
}

Eigen::VectorXd spectral_slopes(const Kernel& kernel, const Eigen::VectorXd& eigenvalues) {
  const Eigen::ArrayXd x = eigenvalues.array() * kernel.length_m * kernel.length_m;
  if (kernel.family == KernelFamily::SquaredExponential) return -x * (-0.5 * x).exp();
  const double nu = smoothness(kernel.family);
  return -(nu + 1.0) * (x / nu) * (1.0 + x / (2.0 * nu)).pow(-(nu + 2.0));
}

double plane_variance(const Kernel& kernel) {
  return 1.0 / (2.0 * std::numbers::pi * kernel.length_m * kernel.length_m);
}

SpectrumRange range_for(KernelFamily family, const LengthRange& lengths) {
  const bool one_length = lengths.least_m == lengths.most_m;
  return {.greatest = end_of_spectrum(family, one_length) / (lengths.least_m * lengths.least_m),
          .margin_m = (one_length ? kMargin : 1.0) * lengths.most_m};
}

LengthRange lengths_to_learn(double median_m) {
  return {.least_m = 0.6 * median_m, .most_m = 2.0 * median_m};
}

}  // namespace palpation
