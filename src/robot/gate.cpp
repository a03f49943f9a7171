#include "palpation/robot/gate.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpation/base/error.h"
#include "palpation/robot/crtk.h"
#include "robot/gate_words.h"

namespace palpation {
namespace {

/// Clocks of two programs on one machine differ by no more, nor does one that is set right.
constexpr double kFromTheFuture_s = 0.005;

std::string stamp_fault(double stamp_s, double now_s, const char* what) {
  const std::string name(what);
  if (!std::isfinite(stamp_s) || stamp_s <= 0.0)
    return "a " + name + " with the stamp " + text_of(stamp_s) + ", which is none";
  if (stamp_s > now_s + kFromTheFuture_s)
    return "a " + name + " that is " + ms_text(stamp_s - now_s) +
           " from the future: the clocks differ";
  return {};
}

std::string stop_fault(const GateStop& stop) {
  if (!stop.surface.allFinite() || !stop.normal.allFinite() ||
      std::abs(stop.normal.norm() - 1.0) > 1e-6)
    return "the stop's place is not finite, or its normal no unit vector";
  if (!(stop.indent_m > 0.0 && stop.indent_m <= 0.1 && stop.standoff_m > 0.0 &&
        stop.standoff_m <= 1.0))
    return "the stop's indentation, " + mm_text(stop.indent_m) + ", or standoff, " +
           mm_text(stop.standoff_m) + ", is none";
  return {};
}

}  // namespace

Gate::Gate(GateLimits limits, HeightOverTissue height)
    : limits_(std::move(limits)), height_(std::move(height)) {
  check(limits_);
  require(static_cast<bool>(height_), "Gate", "the height over the tissue", "must be a function");
}

Verdict Gate::hold(const std::string& words) {
  if (held_for_.empty()) held_for_ = words;
  return {Answer::Hold, words};
}

Verdict Gate::held() const {
  return {Answer::Hold, "it holds until a person acknowledges: " + held_for_};
}

/// What was heard by a clock that then went back would look fresh until it is reached again.
std::string Gate::clock_fault(double now_s) {
  if (!std::isfinite(now_s)) return "the time " + text_of(now_s) + " is none";
  const double back_s = heard_.now_s - now_s;
  if (back_s <= kFromTheFuture_s) {
    heard_.now_s = std::max(heard_.now_s, now_s);
    return {};
  }
  heard_ = {.condition = heard_.condition, .now_s = now_s};
  if (heard_.condition) heard_.condition->stamp_s = 0.0;  // it is said only when it changes
  return "the time went back by " + ms_text(back_s) + ": all that was heard is of another time";
}

Verdict Gate::hear(const ArmPose& pose, double now_s) {
  if (std::string fault = clock_fault(now_s); !fault.empty()) return hold(fault);
  if (std::string fault = stamp_fault(pose.stamp_s, now_s, "pose"); !fault.empty())
    return hold(fault);
  if (std::string fault = pose_fault(pose); !fault.empty()) return hold("the arm says " + fault);
  if (heard_.pose && pose.stamp_s < heard_.pose->stamp_s) return {};
  heard_.pose = pose;
  if (stop_ && motion_.sent) {
    const double away_m = (pose.position - motion_.sent->position).norm();
    if (away_m > limits_.motion.astray_m)
      return hold("the tip is " + mm_text(away_m) + " from where it was sent, more than " +
                  mm_text(limits_.motion.astray_m));
  }
  if (std::string fault = pressed_fault(pose.position); !fault.empty()) return hold(fault);
  return held_for_.empty() ? Verdict{} : held();
}

Verdict Gate::hear(const ArmForce& force, double now_s) {
  if (std::string fault = clock_fault(now_s); !fault.empty()) return hold(fault);
  if (std::string fault = stamp_fault(force.stamp_s, now_s, "force"); !fault.empty())
    return hold(fault);
  if (!std::isfinite(force.force_n)) return hold("a force that is no number");
  if (heard_.force && force.stamp_s < heard_.force->stamp_s) return {};
  if (!heard_.force || heard_.force->force_n != force.force_n) heard_.force_since_s = force.stamp_s;
  heard_.force = force;
  const ForceLimits& limit = limits_.force;
  if (std::abs(force.force_n) >= limit.hold_n)
    return hold("the force is " + newton_text(force.force_n) + ", the limit " +
                newton_text(limit.hold_n));
  if (!stop_) return held_for_.empty() ? Verdict{} : held();
  if (force.force_n >= limit.contact_n && motion_.phase == Phase::Air && motion_.sent)
    return hold("the tip touches something in the air: the force is " + newton_text(force.force_n));
  if (force.force_n >= limit.contact_n && motion_.phase == Phase::Search && !motion_.contact &&
      heard_.pose)
    motion_.contact = heard_.pose->position;
  warn_of_force();
  if (!held_for_.empty()) return held();
  return motion_.only_back.empty() ? Verdict{} : Verdict{Answer::Retract, motion_.only_back};
}

void Gate::warn_of_force() {
  const double force_n = heard_.force->force_n;
  if (std::abs(force_n) >= limits_.force.warn_n && motion_.only_back.empty())
    motion_.only_back = "the force was " + newton_text(force_n) + ", from " +
                        newton_text(limits_.force.warn_n) + " on the tip only goes back";
}

Verdict Gate::hear(const ArmCondition& condition, double now_s) {
  if (std::string fault = clock_fault(now_s); !fault.empty()) return hold(fault);
  if (std::string fault = stamp_fault(condition.stamp_s, now_s, "state"); !fault.empty())
    return hold(fault);
  if (!arm_state(condition.state))
    return hold("the arm says that its state is '" + condition.state.substr(0, 40) +
                "', which CRTK does not know");
  if (heard_.condition && condition.stamp_s < heard_.condition->stamp_s) return {};
  heard_.condition = condition;
  if (!held_for_.empty()) return held();
  // While it is under way its own motions keep it busy.
  if (stop_ && (condition.state != word_of(ArmState::Enabled) || !condition.is_homed))
    return hold(unreadiness(heard_));
  return {};
}

Verdict Gate::hear_failure(const std::string& words) {
  return hold("the arm says: " + words.substr(0, 200));
}

Verdict Gate::hold_as_before(const std::string& words) { return hold(words); }

Verdict Gate::begin(const GateStop& stop, double now_s) {
  if (std::string fault = clock_fault(now_s); !fault.empty()) return hold(fault);
  if (!held_for_.empty()) return held();
  if (stop_) return hold("a touch begins before the last one is finished");
  if (std::string fault = staleness(heard_, limits_.data_age_s, now_s); !fault.empty())
    return hold(fault);
  if (std::string fault = unreadiness(heard_); !fault.empty()) return hold(fault);
  if (heard_.condition->is_busy) return hold("the arm is busy with another motion");
  if (std::string fault = stop_fault(stop); !fault.empty()) return hold(fault);
  if (limits_.uncertainty_m + limits_.extra_indent_m > stop.standoff_m)
    return hold("the tissue may lie " + mm_text(limits_.uncertainty_m) +
                " from where it is taken to be: the approach point, " + mm_text(stop.standoff_m) +
                " over it, must be " + mm_text(limits_.extra_indent_m) +
                " higher. Register it anew, or approach from higher up");
  const double deepest_m = stop.indent_m + limits_.extra_indent_m + limits_.uncertainty_m;
  for (const double height_m : {stop.standoff_m, -deepest_m}) {
    const Vec3 place = stop.surface + height_m * stop.normal;
    if ((place.array() < limits_.box_least.array()).any() ||
        (place.array() > limits_.box_most.array()).any())
      return hold("the stop needs " + place_text(place) + ", which is outside of the box");
  }
  stop_ = stop;
  motion_ = Motion{};
  motion_.begun_s = now_s;
  warn_of_force();
  return {};
}

Verdict Gate::permit(Phase phase, const ArmPose& set_point, double now_s) {
  if (std::string fault = clock_fault(now_s); !fault.empty()) return hold(fault);
  if (!held_for_.empty()) return held();
  if (!stop_) return hold("a motion is asked for, and no touch has begun");
  if (Verdict late = watch(now_s); late.answer == Answer::Hold) return late;
  if (std::string fault = pose_fault(set_point); !fault.empty()) return hold("asked for " + fault);
  if (phase == Phase::Search && motion_.phase == Phase::Search && motion_.contact)
    return {Answer::Touches, "the tip touches: press, or go back"};
  if (std::string fault = order_fault(phase); !fault.empty()) return hold(fault);
  if (std::string fault = step_fault(phase, set_point, now_s); !fault.empty()) return hold(fault);
  if (std::string fault = place_fault(phase, set_point); !fault.empty()) return hold(fault);
  if (motion_.only_back.empty() && phase == Phase::Search)
    motion_.only_back = depth_of_search(set_point.position);
  if (!motion_.only_back.empty() && phase != Phase::Retract)
    return {Answer::Retract, motion_.only_back};
  motion_.phase = phase;
  motion_.sent = set_point;
  motion_.sent->stamp_s = now_s;
  return {};
}

Verdict Gate::watch(double now_s) {
  if (std::string fault = clock_fault(now_s); !fault.empty()) return hold(fault);
  if (!held_for_.empty()) return held();
  if (!stop_) return {};
  if (std::string fault = staleness(heard_, limits_.data_age_s, now_s); !fault.empty())
    return hold(fault);
  const MotionLimits& limit = limits_.motion;
  if (motion_.sent && now_s - motion_.sent->stamp_s > limit.settle_s) {
    const double away_m = (heard_.pose->position - motion_.sent->position).norm();
    if (away_m > limit.arrival_m)
      return hold("the tip is " + mm_text(away_m) + " from where it was sent " +
                  ms_text(now_s - motion_.sent->stamp_s) +
                  " ago: the arm cannot go there, or does not");
  }
  const double frozen_s = heard_.force->stamp_s - heard_.force_since_s;
  const bool is_down = motion_.phase == Phase::Search || motion_.phase == Phase::Press;
  const bool moves = motion_.sent && now_s - motion_.sent->stamp_s <= limits_.data_age_s;
  if (limits_.force.frozen_s > 0.0 && is_down && moves && frozen_s > limits_.force.frozen_s)
    return hold("the force is the same to the last digit since " + ms_text(frozen_s) +
                ", while the tip moves: the sensor is stuck");
  return motion_.only_back.empty() ? Verdict{} : Verdict{Answer::Retract, motion_.only_back};
}

Verdict Gate::reading_allowed(double now_s) {
  if (Verdict late = watch(now_s); !late.is_go()) return late;
  if (!stop_ || motion_.phase != Phase::Press || !motion_.sent)
    return {Answer::Retract, "the tip does not press"};
  const double away_m = (heard_.pose->position - motion_.sent->position).norm();
  if (away_m > limits_.motion.arrival_m)
    return {Answer::Retract,
            "the tip is " + mm_text(away_m) + " from where it was sent, more than " +
                mm_text(limits_.motion.arrival_m) + ": a reading would be of another place"};
  return {};
}

Verdict Gate::finish(double now_s) {
  if (Verdict late = watch(now_s); late.answer == Answer::Hold) return late;
  if (!stop_) return {};
  const double height_m = (heard_.pose->position - stop_->surface).dot(stop_->normal);
  if (motion_.phase != Phase::Air && height_m < limits_.uncertainty_m)
    return hold("the touch ends " + mm_text(height_m) + " over the tissue, which may lie " +
                mm_text(limits_.uncertainty_m) + " higher");
  stop_.reset();
  motion_ = Motion{};
  return {};
}

Verdict Gate::acknowledge(double now_s) {
  if (held_for_.empty()) return {};
  if (std::string fault = clock_fault(now_s); !fault.empty()) return hold(fault);
  std::string reason = staleness(heard_, limits_.data_age_s, now_s);
  if (reason.empty()) reason = unreadiness(heard_);
  if (reason.empty() && std::abs(heard_.force->force_n) >= limits_.force.hold_n)
    reason = "the force is still " + newton_text(heard_.force->force_n);
  if (!reason.empty()) return {Answer::Hold, "it cannot go on: " + reason};
  held_for_.clear();
  // Whatever was under way is over: the person may have moved the arm.
  stop_.reset();
  motion_ = Motion{};
  return {};
}

}  // namespace palpation
