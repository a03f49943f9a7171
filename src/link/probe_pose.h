/// Where the probe touched last, and how it was turned.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "palpation/exploration/waypoint.h"
#include "palpation/session/session_state.h"

namespace palpation::link {

/// In the mesh's frame; the probe's z axis points into the tissue.
struct ProbePose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vec3 place = Vec3::Zero();  ///< as it was told, metres
};

/// Follows the touches of a session. The probe is turned from stop to stop as waypoints() turns it,
/// so that the pose is the one that the plan handed out where touches came in its order.
class ProbePath {
 public:
  ProbePath(Surface surface, const Robot& robot) : surface_(std::move(surface)), robot_(robot) {}

  /// The pose of the last row that was touched and lies on the tissue; nothing before the first.
  std::optional<ProbePose> last_of(const std::vector<SessionRow>& rows);

 private:
  void touch(const SessionRow& row);

  Surface surface_;
  Robot robot_;
  std::size_t known_ = 0;                    // rows that were followed
  std::optional<Eigen::Matrix3d> rotation_;  // after the last stop, in the robot's frame
  std::optional<ProbePose> pose_;
};

}  // namespace palpation::link
