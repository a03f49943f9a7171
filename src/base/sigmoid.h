/// The edge of a tumour, as felt (equation (4) of Garg et al. 2016).
#pragma once

#include <cmath>

namespace palpation {

/// 1 / (1 + e^-x), in a form that overflows nowhere.
inline double sigmoid(double x) { return 0.5 + 0.5 * std::tanh(0.5 * x); }

}  // namespace palpation
