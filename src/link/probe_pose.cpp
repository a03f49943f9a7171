#include "link/probe_pose.h"

#include <array>

namespace palpation::link {

std::optional<ProbePose> ProbePath::last_of(const std::vector<SessionRow>& rows) {
  if (rows.size() < known_) {  // another journal lies there now
    known_ = 0;
    rotation_.reset();
    pose_.reset();
  }
  for (; known_ < rows.size(); ++known_) {
    const SessionRow& row = rows[known_];
    if (row.made.kind != TouchKind::Missed && row.off_tissue.empty()) touch(row);
  }
  return pose_;
}

void ProbePath::touch(const SessionRow& row) {
  const std::array<SurfacePoint, 1> here{surface_.project(row.made.place)};
  const Eigen::Matrix3d turned =
      waypoints(surface_, here, robot_, rotation_ ? &*rotation_ : nullptr).back().rotation;
  if (row.made.kind == TouchKind::Stop) rotation_ = turned;
  const Eigen::Matrix3d to_robot = robot_.from_tissue.topLeftCorner<3, 3>();
  pose_ = {to_robot.transpose() * turned, row.made.place};
}

}  // namespace palpation::link
