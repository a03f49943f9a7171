/// Kernels of the surface's Laplacian: what a length means for its waves.
#pragma once

#include <Eigen/Core>

#include "geometry/spectrum.h"
#include "palpation/belief/prior.h"

namespace palpation {

/// Whether the family has a spectral form here.
bool has_spectral_form(KernelFamily family);

/// s of prior.h for every eigenvalue, and its derivative by log length.
Eigen::VectorXd spectral_weights(const Kernel& kernel, const Eigen::VectorXd& eigenvalues);
Eigen::VectorXd spectral_slopes(const Kernel& kernel, const Eigen::VectorXd& eigenvalues);

/// Sum of s over the modes of a square metre of plane: what makes the variance 1 there.
double plane_variance(const Kernel& kernel);

/// What a family asks of a spectrum. `lengths` must be set.
SpectrumRange range_for(KernelFamily family, const LengthRange& lengths);

}  // namespace palpation
