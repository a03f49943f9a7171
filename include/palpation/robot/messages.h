/// What an arm tells, and what it is told, as it came: nothing of it is believed before the gate
/// has looked at it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "palpation/base/types.h"

namespace palpation {

/// Of the probe's tip: measured_cp, and set points. The probe's z points into the tissue.
struct ArmPose {
  double stamp_s = 0.0;  ///< 0: invalid
  std::string frame;
  Vec3 position = Vec3::Zero();
  Eigen::Vector4d quaternion = Eigen::Vector4d(0.0, 0.0, 0.0, 1.0);  ///< x, y, z, w
};

struct ArmForce {
  double stamp_s = 0.0;
  double force_n = 0.0;  ///< that the tissue presses back with, along the probe's axis
};

/// operating_state
struct ArmCondition {
  double stamp_s = 0.0;
  std::string state;  ///< as CRTK spells it
  bool is_homed = false;
  bool is_busy = false;  ///< with a motion that is not the gate's
};

/// The last of each.
struct ArmHeard {
  std::optional<ArmPose> pose{};
  std::optional<ArmForce> force{};
  std::optional<ArmCondition> condition{};
  double force_since_s = 0.0;  ///< it is the same to the last bit since then
  double now_s = 0.0;          ///< the latest time that was told
};

/// Where a plan wants to touch.
struct GateStop {
  Vec3 surface = Vec3::Zero();  ///< on the tissue
  Vec3 normal = Vec3::UnitZ();  ///< outward, unit
  double indent_m = 0.002;      ///< as planned
  double standoff_m = 0.005;    ///< of the approach point
};

/// What a set point is for, in the order of a touch.
enum class Phase {
  Air,      ///< on the way, over the tissue
  Search,   ///< down along the normal, until it touches
  Press,    ///< deeper, from where it touched
  Retract,  ///< back, up along the normal
};

}  // namespace palpation
