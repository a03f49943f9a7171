#include "base/owens_t.h"

#include <array>
#include <cmath>
#include <numbers>

namespace palpation {
namespace {

double upper_tail(double x) { return 0.5 * std::erfc(x / std::numbers::sqrt2); }

/// Gauss and Legendre's rule of ten points on [0, a], a <= 1.
double owens_integral(double h, double a) {
  constexpr std::array kNodes = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244,
                                 0.8650633666889845, 0.9739065285171717};
  constexpr std::array kWeights = {0.2955242247147529, 0.2692667193099963, 0.2190863625159820,
                                   0.1494513491505806, 0.0666713443086881};
  double sum = 0.0;
  for (std::size_t i = 0; i < kNodes.size(); ++i) {
    for (const double side : {-1.0, 1.0}) {
      const double x = 0.5 * a * (1.0 + side * kNodes[i]);
      sum += kWeights[i] * std::exp(-0.5 * h * h * (1.0 + x * x)) / (1.0 + x * x);
    }
  }
  return 0.5 * a * sum / (2.0 * std::numbers::pi);
}

}  // namespace

double owens_t(double h, double a) {
  h = std::abs(h);
  if (a < 0.0) return -owens_t(h, -a);
  if (std::isinf(a)) return 0.5 * upper_tail(h);
  if (a <= 1.0) return owens_integral(h, a);
  const double p = upper_tail(h), q = upper_tail(a * h);
  return 0.5 * (p + q) - p * q - owens_integral(a * h, 1.0 / a);
}

}  // namespace palpation
