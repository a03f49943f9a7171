/// Where the probe goes: poses for a robot.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// The robot and how it touches. The probe is the PALP: its tip gives way along its axis like a
/// spring (Garg et al. 2016, section VII).
struct Robot {
  Eigen::Matrix4d from_tissue =
      Eigen::Matrix4d::Identity();  ///< rigid: p_robot = from_tissue * p_tissue
  double standoff_m = 0.005;        ///< of the approach point, along the normal
  double indent_m = 0.002;          ///< into the tissue, along the normal
  double spring_n_per_m = 80.0;     ///< 0.08 N/mm
};

/// Throws InvalidInput unless the transform is rigid to 1e-6 and lengths and spring are finite and
/// not negative.
void check(const Robot& robot);

/// A stop or a place on the way. Positions, normal and rotation are in the robot's frame.
struct Waypoint {
  SurfacePoint target;
  Vec3 position = Vec3::Zero();  ///< on the tissue
  Vec3 normal = Vec3::UnitZ();   ///< outward, unit
  Vec3 approach = Vec3::Zero();  ///< standoff above
  Vec3 indented = Vec3::Zero();  ///< where the tip ends
  Eigen::Matrix3d rotation =
      Eigen::Matrix3d::Identity();  ///< of the probe: its z points into the tissue
  double expected_force_n = 0.0;    ///< F = k d, if the tissue does not give way at all
};

/// Unit quaternion (x, y, z, w), w >= 0.
Eigen::Vector4d quaternion(const Eigen::Matrix3d& rotation);

/// One waypoint per target, in order. Each pose is the one before it under the least rotation that
/// turns its z to the new direction; `before` is the probe's rotation at the start, by default its
/// z into the tissue and its x nearest to the robot's x.
std::vector<Waypoint> waypoints(const Surface& surface, std::span<const SurfacePoint> targets,
                                const Robot& robot, const Eigen::Matrix3d* before = nullptr);

}  // namespace palpation
