/// The standard normal distribution, of one variable and of two.
#pragma once

namespace palpation {

/// What its log density lacks at z of that at 0.
inline double half_square(double z) { return 0.5 * z * z; }

/// Probability of a value below x.
double normal_probability(double x);

/// Its inverse, for 0 < probability < 1.
double normal_quantile(double probability);

/// T(h, a), the probability that one normal exceeds h while another, independent one lies between 0
/// and a times it (Owen 1956).
double owens_t(double h, double a);

}  // namespace palpation
