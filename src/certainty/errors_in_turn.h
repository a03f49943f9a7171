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

/// Their covariance at each of the first `count` readings with those of what the belief takes as
/// one.
Eigen::MatrixXd errors_at_each(Eigen::Index count, std::span<const std::vector<Made>> made,
                               double readings);

/// The mean of what is of each reading, in the order in which they were made, over those that the
/// belief takes as one.
Eigen::VectorXd mean_in_turn(const Eigen::VectorXd& of_each,
                             std::span<const std::vector<Made>> made);

/// What one unit of each of few coefficients adds to each, for errors of height one that last over
/// `readings`, or over the fewest more by which they are no more than `most`.
Eigen::MatrixXd terms_of_errors(std::span<const std::vector<Made>> made, double readings,
                                Eigen::Index most);

}  // namespace palpation
