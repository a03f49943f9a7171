/// What a motion may be at most. Metres, newtons, seconds, radians, in the robot's base frame.
#pragma once

#include <numbers>
#include <string>

#include "palpation/base/types.h"

namespace palpation {

struct ForceLimits {
  double contact_n = 0.1;            ///< from here on the tip is taken to touch
  double warn_n = 2.0;               ///< from here on only back
  double hold_n = 5.0;               ///< from here on nothing
  double stiffest_n_per_m = 5000.0;  ///< of the tissue, 5 N/mm: what a late reading may cost
  double frozen_s = 0.08;  ///< a force that stays the same to the last bit for so long while the
                           ///< tip moves in contact or in search of it is no reading; 0: it may
};

struct MotionLimits {
  double air_m_per_s = 0.030;
  double contact_m_per_s = 0.005;  ///< in search of contact, and pressing
  double turn_rad_per_s = 1.0;
  double step_m = 0.001;      ///< from one set point to the next
  double astray_m = 0.002;    ///< of the tip from where it was sent
  double arrival_m = 0.0005;  ///< so near is there
  double settle_s = 1.0;      ///< and there it must be after so long
};

/// The tip is so near to the normal through its stop, and its axis to the normal.
struct ApproachCone {
  double foot_m = 0.001;                     ///< radius at the tissue and below
  double wall_rad = 0.26;                    ///< 15 degrees: the cone opens above
  double axis_rad = std::numbers::pi / 9.0;  ///< 20 degrees, of the probe from the inward normal
  double axis_in_air_rad = 1.05;             ///< 60 degrees, on the way there
};

struct GateLimits {
  ForceLimits force{};
  MotionLimits motion{};
  ApproachCone cone{};
  Vec3 box_least = Vec3::Zero(), box_most = Vec3::Zero();  ///< the tip is in this box
  double extra_indent_m = 0.001;  ///< deeper than planned, after contact, at most
  /// How far, along the normal, the tissue may lie from where it is taken to be. It widens the
  /// stretch that is searched for contact, and nothing else.
  double uncertainty_m = 0.001;
  double data_age_s = 0.050;  ///< of pose and force
  std::string frame = "";     ///< that poses are in, as their messages say
};

/// Throws InvalidInput, naming value and rule, unless all are finite and positive (frozen_s may be
/// 0), contact < warn < hold, the box has an inside, angles are below a right one, and what the
/// stiffest tissue adds at contact speed while data get old leaves a force that was below warn_n
/// below hold_n.
void check(const GateLimits& limits);

}  // namespace palpation
