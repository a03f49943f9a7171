/// Words and figures for a refusal.
#pragma once

#include <string>

#include "palpation/base/types.h"
#include "palpation/robot/messages.h"

namespace palpation {

std::string mm_text(double metres);
std::string mm_per_s_text(double metres_per_s);
std::string newton_text(double newtons);
std::string ms_text(double seconds);
std::string degrees_text(double radians);
std::string place_text(const Vec3& metres);

/// Why what was heard is too old, or missing; empty: it is not.
std::string staleness(const ArmHeard& heard, double data_age_s, double now_s);
/// Why the arm is not ready; empty: it is.
std::string unreadiness(const ArmHeard& heard);

/// The probe's axis, of a quaternion that is one.
Vec3 axis_of(const ArmPose& pose);
/// Of the turn from one to the other; q and -q are one.
double turn_between(const ArmPose& a, const ArmPose& b);
/// Between two unit vectors.
double angle_between(const Vec3& a, const Vec3& b);

}  // namespace palpation
