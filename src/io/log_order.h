/// Samples of a log in the order in which they were made.
#pragma once

#include <string>
#include <vector>

#include "palpation/probing/robot_log.h"

namespace palpation {

/// By stamps, or by the sample's number within each probing where there are none; sentences on what
/// was moved. A clock that was set back goes on behind a gap. `sample`: as many, or none.
std::vector<std::string> put_in_order(RobotLog& log, const Eigen::VectorXd& sample);

}  // namespace palpation
