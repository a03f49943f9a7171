/// Kernels of the distance alone, for loops over many pairs of places: all but the periodic one.
#pragma once

#include "palpation/belief/kernel.h"

namespace palpation {

/// Farther than this e^-s is 0, and times a polynomial of infinity nothing.
inline constexpr double kFar = 800.0;

/// Lengths whose square is far from the least and the greatest number: for others (d / length)^2 is
/// not d^2 / length^2.
inline bool has_usual_length(const Kernel& kernel) {
  return kernel.length_m > 1e-100 && kernel.length_m < 1e100;
}

/// Of a Matern kernel: s^2 over |difference / length|^2, s as correlation() has it.
inline double matern_scale(KernelFamily family) {
  if (family == KernelFamily::Matern12) return 1.0;
  return family == KernelFamily::Matern32 ? 3.0 : 5.0;
}

}  // namespace palpation
