/// A probing's samples along one line: depth into the tissue and force against it, whichever way a
/// robot counts.
#pragma once

#include <vector>

#include "palpation/probing/indentation.h"
#include "palpation/probing/robot_log.h"

namespace palpation {

struct AxialProbing {
  std::vector<Eigen::Index> rows;  ///< of the log
  Vec3 outward = Vec3::Zero();     ///< unit; zero where it is not known
  Indentation indentation;         ///< a value a row
};

/// All of a log, their signs taken together.
struct AxialLog {
  std::vector<AxialProbing> probings;
  bool pressing_is_negative = false;  ///< as the log counts its force
  bool has_axes = false;              ///< lines of action are known, by normals or by motion
};

AxialLog along_axes(const RobotLog& log, const std::vector<std::vector<Eigen::Index>>& groups);

}  // namespace palpation
