/// Statistics that a few bad values do not move.
#pragma once

#include <vector>

namespace palpation {

/// Linear between order statistics. Requires a value, and q in [0, 1].
double quantile(std::vector<double> values, double q);
double median(const std::vector<double>& values);
/// 1.4826 times the median absolute deviation from the median: the standard deviation, of normal
/// values.
double robust_sd(const std::vector<double>& values);

}  // namespace palpation
