/// The edge of a tumour, as felt (equation (4) of Garg et al. 2016).
#pragma once

#include <cmath>

namespace palpation {

/// Of an x far below 0 the exponential is infinite, and this is 0.
inline double sigmoid(double x) { return 1.0 / (1.0 + std::exp(-x)); }

}  // namespace palpation
