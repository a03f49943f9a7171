/// The last word between a plan and an arm: every set point passes it or is not sent.
///
///     Gate gate(limits, height_over_tissue);
///     gate.hear(pose, now), gate.hear(force, now), gate.hear(condition, now);   as they come
///     if (gate.begin(stop, now).is_go() && gate.permit(Phase::Air, set_point, now).is_go()) send
///     if (gate.watch(now).answer == Answer::Hold) hold                          100 times a second
///
/// Laws, whatever it is told and in whatever order: (1) what is permitted is finite, in the frame,
/// the box and the cone, within step and speed of the set point before, over the tissue in the air,
/// no deeper in search than the uncertainty and the extra indentation allow, and after contact no
/// deeper than planned and the extra, and no wait earns a step longer than a data age does; (2) it
/// rests on a pose and a force no older than the data age, by a clock that does not go back; (3)
/// from warn_n on only a retreat is permitted, from hold_n on nothing; (4) after any answer Hold
/// nothing is permitted until acknowledge; (5) limits of force and of indentation never grow. It
/// has no clock: times are arguments, in seconds, those of messages on the same clock.
///
/// It is no certified safety: it knows what it is told, and tissue that moves is not modelled.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "palpation/robot/limits.h"
#include "palpation/robot/messages.h"

namespace palpation {

enum class Answer {
  Go,
  Touches,  ///< not this: a search is over, press
  Retract,  ///< not this: go back along the normal. Too much force, or no contact as deep as may be
            ///< searched: the stop could not be touched
  Hold      ///< hold, and wait for a person
};

struct Verdict {
  Answer answer = Answer::Go;
  std::string words{};  ///< why, with the figures; empty for Go
  bool is_go() const { return answer == Answer::Go; }
};

/// How high over the tissue, where it is taken to be, a place in the robot's frame lies; negative
/// inside.
using HeightOverTissue = std::function<double(const Vec3&)>;

class Gate {
 public:
  /// Throws InvalidInput as check(GateLimits) does.
  Gate(GateLimits limits, HeightOverTissue height);

  /// What the arm says. One that is no message (not finite, stamp 0 or of the future, another
  /// frame, a quaternion that is none, an unknown state) is a fault, and so is, while a touch is
  /// under way, an arm that is not enabled and homed. An older message than the last is left out.
  Verdict hear(const ArmPose& pose, double now_s);
  Verdict hear(const ArmForce& force, double now_s);
  Verdict hear(const ArmCondition& condition, double now_s);
  /// The arm says that it failed, such as goal_reached(false) or an error event.
  Verdict hear_failure(const std::string& words);
  /// For what another gate of the same arm held, which nobody has acknowledged yet.
  Verdict hold_as_before(const std::string& words);

  /// A touch begins: the arm is ready, its data are fresh, the stop is in the box and its approach
  /// point higher than the tissue may be.
  Verdict begin(const GateStop& stop, double now_s);
  /// May this be sent? Its quaternion is to be normalized; q and -q are one.
  Verdict permit(Phase phase, const ArmPose& set_point, double now_s);
  /// Looks whether anything is late: data, or the arm behind where it was sent.
  Verdict watch(double now_s);
  /// May a reading be taken here: pressed, arrived, fresh?
  Verdict reading_allowed(double now_s);
  /// The touch is over: the tip is over the tissue again.
  Verdict finish(double now_s);

  /// A person has looked. Refused, in words, while what the arm says is no reason to go on.
  Verdict acknowledge(double now_s);

  const std::string& held_for() const { return held_for_; }  ///< empty: it does not hold
  bool is_touching() const { return motion_.contact.has_value(); }
  bool is_under_way() const { return stop_.has_value(); }
  const GateLimits& limits() const { return limits_; }

 private:
  struct Motion {
    Phase phase = Phase::Air;
    double begun_s = 0.0;
    std::optional<ArmPose> sent;  ///< the last set point, stamped when it was permitted
    std::optional<Vec3> contact;  ///< where the tip was when it touched
    std::string only_back;        ///< why only a retreat is permitted; empty: all is
  };

  Verdict hold(const std::string& words);
  std::string clock_fault(double now_s);
  Verdict held() const;
  void warn_of_force();
  std::string pose_fault(const ArmPose& pose) const;
  std::string order_fault(Phase phase) const;
  std::string step_fault(Phase phase, const ArmPose& set_point, double now_s) const;
  std::string place_fault(Phase phase, const ArmPose& set_point) const;
  std::string depth_of_search(const Vec3& position) const;
  std::string pressed_fault(const Vec3& tip) const;
  std::string depth_fault(Phase phase, const Vec3& position) const;
  std::string cone_fault(Phase phase, const ArmPose& set_point) const;

  GateLimits limits_;
  HeightOverTissue height_;
  ArmHeard heard_;
  std::optional<GateStop> stop_;
  Motion motion_;
  std::string held_for_;
};

}  // namespace palpation
