/// The standard normal distribution.
#pragma once

namespace palpation {

/// Probability of a value below x.
double normal_probability(double x);

/// Its inverse, for 0 < probability < 1.
double normal_quantile(double probability);

}  // namespace palpation
