/// Readings as two plateaus on one background.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace palpation {

/// What both plateaus share: each value is raised by its row of `terms` (n x k) times coefficients,
/// which are normal around zero with these precisions (k); 0: wholly unknown.
struct SharedBackground {
  Eigen::MatrixXd terms;
  Eigen::VectorXd precision;
};

/// Values are those of one of two parallel surfaces, and normal noise, but for one in ten that may
/// lie anywhere between 0 and 1.
struct ParallelSurfaces {
  double low = 0.0;
  double contrast = 0.0;
  Eigen::VectorXd coefficients;
  double high_share = 0.0;
  double variance = 0.0;        ///< of the noise
  double log_likelihood = 0.0;  ///< of the values by the background that was found
  /// Of the values by any background (Laplace), where none of the precisions is 0.
  double log_evidence = 0.0;
};

/// By expectation and maximization, from a first background at the values, which lie in [0, 1] and
/// are two at least.
ParallelSurfaces parallel_surfaces(const SharedBackground& background,
                                   const Eigen::VectorXd& values,
                                   const Eigen::VectorXd& first_background);

/// From no background, and from how high the lower and higher values of those that are alike in it
/// lie: it is no matter how many lie on either surface.
std::vector<ParallelSurfaces> all_parallel_surfaces(const SharedBackground& background,
                                                    const Eigen::VectorXd& values);

/// Some of many values, from 0 for the least to 1.
struct SomeValues {
  std::vector<std::size_t> rows;  ///< which
  Eigen::VectorXd scaled;         ///< as they are where all are alike
  double range = 0.0;
};
/// Every so many in this order of their rows, `most` at most.
SomeValues some_of(const Eigen::VectorXd& values, std::span<const std::size_t> order,
                   std::size_t most);

}  // namespace palpation
