/// Spread that a few wild values do not move, and variances that few degrees of freedom allow.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace palpation {

/// NaN of none.
inline double median_of(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// 1.4826 times the median distance from zero: the standard deviation where they are Gaussian.
inline double robust_sd(const Eigen::VectorXd& residuals) {
  std::vector<double> sizes(static_cast<std::size_t>(residuals.size()));
  for (Eigen::Index i = 0; i < residuals.size(); ++i)
    sizes[static_cast<std::size_t>(i)] = std::abs(residuals[i]);
  return 1.4826 * median_of(std::move(sizes));
}

/// The variance of an error that a sum of squares estimates with these degrees of freedom, the
/// doubt about the estimate included: that of Student's t. NaN where three degrees are not there.
inline double student_variance(double squares, int degrees) {
  if (degrees < 3) return std::numeric_limits<double>::quiet_NaN();
  return squares / (degrees - 2);
}

}  // namespace palpation
