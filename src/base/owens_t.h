/// A function of two normal variables (Owen 1956).
#pragma once

namespace palpation {

/// Owen's T(h, a), the probability that one normal exceeds h while another, independent one lies
/// between 0 and a times it; to 1e-12.
double owens_t(double h, double a);

}  // namespace palpation
