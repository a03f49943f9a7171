/// Stretches of a log that hang together: no gap in time, no jump in space.
#pragma once

#include <vector>

#include "palpation/probing/robot_log.h"

namespace palpation {

struct Stretch {
  Eigen::Index first = 0, last = 0;  ///< samples, both included
  Eigen::Index size() const { return last - first + 1; }
};

/// The median step between stamps, of those that step at all.
double usual_step_s(const RobotLog& log);

/// Cut where stamps step by more than gap_s or not forward, and where the session changes.
std::vector<Stretch> stretches_in_time(const RobotLog& log, double gap_s);

/// Those whose stamp, position and force are finite, of what the log has.
RobotLog finite_samples(const RobotLog& log);

/// The samples of a log at these rows.
RobotLog samples_of(const RobotLog& log, const std::vector<Eigen::Index>& rows);

}  // namespace palpation
