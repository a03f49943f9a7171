#include "palpation/robot/limits.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2.0;
constexpr double kFarthest_m = 1e3;

void require_positive(double value, const char* name) {
  require(std::isfinite(value) && value > 0.0, "GateLimits",
          std::string(name) + " " + text_of(value), "must be finite and positive");
}

void check_forces(const GateLimits& limits) {
  const ForceLimits& force = limits.force;
  for (const auto& [value, name] : {std::pair(force.contact_n, "contact_n"),
                                    {force.warn_n, "warn_n"},
                                    {force.hold_n, "hold_n"},
                                    {force.stiffest_n_per_m, "stiffest_n_per_m"}})
    require_positive(value, name);
  require(std::isfinite(force.frozen_s) && force.frozen_s >= 0.0, "GateLimits",
          "frozen_s " + text_of(force.frozen_s), "must be finite and not negative");
  require(force.contact_n < force.warn_n && force.warn_n < force.hold_n, "GateLimits",
          "contact_n " + text_of(force.contact_n) + ", warn_n " + text_of(force.warn_n) +
              ", hold_n " + text_of(force.hold_n),
          "must rise");
  const double late_n = force.stiffest_n_per_m * limits.motion.contact_m_per_s * limits.data_age_s;
  require(force.warn_n + late_n <= force.hold_n, "GateLimits",
          "warn_n " + text_of(force.warn_n) + " and the " + text_of(late_n) +
              " N that the stiffest tissue adds at contact speed while data get as old as they may",
          "must be no more than hold_n " + text_of(force.hold_n) +
              ": move slower, or take fresher data");
}

void check_cone(const ApproachCone& cone) {
  require_positive(cone.foot_m, "foot_m");
  for (const auto& [angle, name] : {std::pair(cone.wall_rad, "wall_rad"),
                                    {cone.axis_rad, "axis_rad"},
                                    {cone.axis_in_air_rad, "axis_in_air_rad"}})
    require(angle > 0.0 && angle < kRightAngle, "GateLimits",
            std::string(name) + " " + text_of(angle), "must be above 0 and below a right angle");
}

}  // namespace

void check(const GateLimits& limits) {
  const MotionLimits& motion = limits.motion;
  for (const auto& [value, name] : {std::pair(motion.air_m_per_s, "air_m_per_s"),
                                    {motion.contact_m_per_s, "contact_m_per_s"},
                                    {motion.turn_rad_per_s, "turn_rad_per_s"},
                                    {motion.step_m, "step_m"},
                                    {motion.astray_m, "astray_m"},
                                    {motion.arrival_m, "arrival_m"},
                                    {motion.settle_s, "settle_s"},
                                    {limits.extra_indent_m, "extra_indent_m"},
                                    {limits.uncertainty_m, "uncertainty_m"},
                                    {limits.data_age_s, "data_age_s"}})
    require_positive(value, name);
  check_cone(limits.cone);
  check_forces(limits);
  require(limits.box_least.allFinite() && limits.box_most.allFinite() &&
              limits.box_least.cwiseAbs().maxCoeff() <= kFarthest_m &&
              limits.box_most.cwiseAbs().maxCoeff() <= kFarthest_m &&
              (limits.box_least.array() < limits.box_most.array()).all(),
          "GateLimits", "box", "must have an inside, within 1 km of the robot's base");
}

}  // namespace palpation
