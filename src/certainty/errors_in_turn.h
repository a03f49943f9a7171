/// Errors that last over some readings, in the order in which these were made: a sensor that warms,
/// its filter, a cable, a hand. Their covariance fades with every reading (Ornstein and Uhlenbeck).
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "palpation/readings/palpation.h"

namespace palpation {

/// Of errors of height one that last over `readings`: rows and columns are what the belief takes as
/// one, each the mean over the readings that it was made of.
Eigen::MatrixXd errors_in_turn(std::span<const std::vector<Made>> made, double readings);

/// What one unit of each of few coefficients adds to each, by the pivoted Cholesky decomposition
/// (Harbrecht, Peters and Schneider 2012): without at most a twentieth of any variance, which is
/// noise then.
Eigen::MatrixXd few_terms(const Eigen::MatrixXd& covariance);

}  // namespace palpation
