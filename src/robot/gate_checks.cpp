// What is wrong with a pose, or a set point: words with the figures, or nothing.
#include <algorithm>
#include <cmath>

#include "palpation/base/error.h"
#include "palpation/robot/crtk.h"
#include "palpation/robot/gate.h"
#include "robot/gate_words.h"

namespace palpation {
namespace {

/// A quaternion is one within a hundredth of length 1: messages round to single precision at worst.
constexpr double kUnitWithin = 0.01;
/// Rounding, of lengths and angles that are allowed to be equal to their limits.
constexpr double kRounding = 1e-9;

}  // namespace

std::string staleness(const ArmHeard& heard, double data_age_s, double now_s) {
  const auto late = [&](const char* what, double stamp_s) {
    return "the last " + std::string(what) + " is " + ms_text(now_s - stamp_s) +
           " old, more than " + ms_text(data_age_s);
  };
  if (!heard.pose) return "the arm has not said where it is";
  if (!heard.force) return "no force was heard";
  if (!(now_s - heard.pose->stamp_s <= data_age_s)) return late("pose", heard.pose->stamp_s);
  if (!(now_s - heard.force->stamp_s <= data_age_s)) return late("force", heard.force->stamp_s);
  return {};
}

std::string unreadiness(const ArmHeard& heard) {
  if (!heard.condition) return "the arm has not said in which state it is";
  if (heard.condition->state != word_of(ArmState::Enabled))
    return "the arm is " + heard.condition->state + ", not ENABLED";
  if (!heard.condition->is_homed) return "the arm is not homed";
  return {};
}

std::string Gate::pose_fault(const ArmPose& pose) const {
  if (pose.frame != limits_.frame)
    return "a pose in the frame '" + pose.frame.substr(0, 40) + "', " +
           (limits_.frame.empty() ? "and it was not said which is the robot's (robot.frame)"
                                  : "not in '" + limits_.frame + "'");
  if (!pose.position.allFinite() || !pose.quaternion.allFinite()) return "a pose that is no number";
  if (pose.position.cwiseAbs().maxCoeff() > 1e3)
    return "a pose " + place_text(pose.position) + ", kilometres away: is it in millimetres?";
  if (std::abs(pose.quaternion.norm() - 1.0) > kUnitWithin)
    return "a quaternion of length " + text_of(pose.quaternion.norm()) + ", which is no rotation";
  return {};
}

/// Down only where it touched, or looks for it; in the air again only from above.
std::string Gate::order_fault(Phase phase) const {
  const Phase before = motion_.phase;
  if (phase == Phase::Retract) return {};
  if (phase == Phase::Air && before == Phase::Air) return {};
  if (phase == Phase::Air) {
    const bool is_back = before == Phase::Retract && motion_.sent &&
                         height_(motion_.sent->position) >= limits_.uncertainty_m;
    return is_back ? "" : "a way in the air that begins in the tissue: go back first";
  }
  if (before == Phase::Retract) return "a way down before the tip is in the air again";
  if (phase == Phase::Search && motion_.contact)
    return "a search for contact, and the tip touches: press or go back";
  // Contact is where the force rises: it must not have risen before.
  if (phase == Phase::Search && before == Phase::Air && !motion_.sent &&
      height_(heard_.pose->position) < limits_.uncertainty_m)
    return "a search that begins in the tissue: go back first";
  if (phase == Phase::Search) return {};
  return motion_.contact ? "" : "a press before the tip has touched";
}

std::string Gate::step_fault(Phase phase, const ArmPose& set_point, double now_s) const {
  const MotionLimits& limit = limits_.motion;
  const ArmPose& from = motion_.sent ? *motion_.sent : *heard_.pose;
  const double step_m = (set_point.position - from.position).norm();
  if (step_m > limit.step_m * (1.0 + kRounding))
    return "a step of " + mm_text(step_m) + ", more than " + mm_text(limit.step_m);
  const bool in_contact = phase != Phase::Air;
  const double speed_limit = in_contact ? limit.contact_m_per_s : limit.air_m_per_s;
  // Who waited may not jump: in contact a step is force before anybody has felt it.
  const double taken_s =
      std::min(now_s - (motion_.sent ? from.stamp_s : motion_.begun_s), limits_.data_age_s);
  if (!(step_m <= speed_limit * taken_s * (1.0 + kRounding)))
    return "a step of " + mm_text(step_m) + " in " + ms_text(taken_s) + ", faster than " +
           mm_per_s_text(speed_limit) + (in_contact ? " at the tissue" : " in the air");
  const double turn_rad = turn_between(from, set_point);
  if (!(turn_rad <= limit.turn_rad_per_s * taken_s * (1.0 + kRounding) + kRounding))
    return "a turn of " + degrees_text(turn_rad) + " in " + ms_text(taken_s) + ", faster than " +
           degrees_text(limit.turn_rad_per_s) + " a second";
  return {};
}

std::string Gate::place_fault(Phase phase, const ArmPose& set_point) const {
  const Vec3& position = set_point.position;
  if ((position.array() < limits_.box_least.array()).any() ||
      (position.array() > limits_.box_most.array()).any())
    return place_text(position) + " is outside of the box from " + place_text(limits_.box_least) +
           " to " + place_text(limits_.box_most);
  if (phase == Phase::Air) {
    const double height_m = height_(position);
    if (!(height_m >= limits_.uncertainty_m))
      return "a way in the air " + mm_text(height_m) + " over the tissue, which may lie " +
             mm_text(limits_.uncertainty_m) + " higher";
  }
  if (std::string fault = cone_fault(phase, set_point); !fault.empty()) return fault;
  return depth_fault(phase, position);
}

/// That there is no contact as deep as may be searched is no fault, but the end of the search.
std::string Gate::depth_of_search(const Vec3& position) const {
  const double depth_m = (stop_->surface - position).dot(stop_->normal);
  const double searched_m = limits_.uncertainty_m + limits_.extra_indent_m;
  if (depth_m <= searched_m + kRounding) return {};
  return "no contact down to " + mm_text(searched_m) + " below where the tissue is taken to be";
}

/// The tip itself may be deeper than where it was sent.
std::string Gate::pressed_fault(const Vec3& tip) const {
  if (!stop_ || !motion_.contact) return {};
  const double pressed_m = (*motion_.contact - tip).dot(stop_->normal);
  const double most_m = stop_->indent_m + limits_.extra_indent_m + limits_.motion.arrival_m;
  if (pressed_m <= most_m) return {};
  return "the tip is " + mm_text(pressed_m) + " deeper than where it touched, more than " +
         mm_text(most_m);
}

std::string Gate::depth_fault(Phase phase, const Vec3& position) const {
  if (phase == Phase::Air) return {};
  const auto depth_of = [&](const Vec3& place) {
    return (stop_->surface - place).dot(stop_->normal);
  };
  const double depth_m = depth_of(position);
  if (phase == Phase::Retract) {
    const Vec3& from = motion_.sent ? motion_.sent->position : heard_.pose->position;
    return depth_m <= depth_of(from) + kRounding
               ? ""
               : "a retreat that goes " + mm_text(depth_m - depth_of(from)) + " deeper";
  }
  if (phase != Phase::Press) return {};
  const double pressed_m = depth_m - depth_of(*motion_.contact);
  const double most_m = stop_->indent_m + limits_.extra_indent_m;
  if (pressed_m > most_m + kRounding)
    return "an indentation of " + mm_text(pressed_m) + " from where it touched, more than the " +
           mm_text(stop_->indent_m) + " planned and " + mm_text(limits_.extra_indent_m);
  return {};
}

std::string Gate::cone_fault(Phase phase, const ArmPose& set_point) const {
  const ApproachCone& cone = limits_.cone;
  const double off_rad = angle_between(axis_of(set_point), -stop_->normal);
  const double most_rad = phase == Phase::Air ? cone.axis_in_air_rad : cone.axis_rad;
  if (!(off_rad <= most_rad + kRounding))
    return "a probe " + degrees_text(off_rad) + " from the tissue's inward normal, more than " +
           degrees_text(most_rad);
  if (phase == Phase::Air) return {};
  const Vec3 from_stop = set_point.position - stop_->surface;
  const double height_m = from_stop.dot(stop_->normal);
  const double beside_m = (from_stop - height_m * stop_->normal).norm();
  const double wide_m = cone.foot_m + std::max(height_m, 0.0) * std::tan(cone.wall_rad);
  if (!(beside_m <= wide_m + kRounding))
    return "a place " + mm_text(beside_m) + " beside the normal through the stop, " +
           mm_text(height_m) + " over it: outside of the approach cone, " + mm_text(wide_m) +
           " wide there";
  if (height_m > stop_->standoff_m + limits_.motion.step_m && phase == Phase::Search)
    return "a search from " + mm_text(height_m) + " over the tissue, above the approach point";
  return {};
}

}  // namespace palpation
