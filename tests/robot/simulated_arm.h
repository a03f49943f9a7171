/// An arm over elastic tissue in simulated time, and faults that can be switched on: enough to hold
/// the gate against.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "palpation/base/random.h"
#include "palpation/robot/gate.h"
#include "robot/gate_play.h"

namespace palpation {

enum class ArmFault {
  None,
  StalePose,
  StaleForce,
  FrameChange,
  StampZero,
  NotANumber,
  ZeroQuaternion,
  StateFault,
  Unhomed,
  Failure,        ///< goal_reached(false), as after inverse kinematics that have no answer
  ClippedJoints,  ///< the tip goes elsewhere
  StuckForce,
  KilledMaster  ///< nothing comes any more
};

/// The tissue's true surface is flat at `surface_m`; the tip follows its set points at once.
struct SimulatedArm {
  Gate gate;
  double surface_m = 0.0;
  double stiffness_n_per_m = 500.0;
  ArmFault fault = ArmFault::None;
  double fault_from_s = 1e9;
  std::uint64_t seed = 1;
  int late_ticks = 0;  ///< so late a force comes, and says so

  double now_s = 1.0;
  Vec3 tip = Vec3(0.0, 0.0, 0.006);
  double most_n = 0.0;
  double held_at_s = 0.0;    ///< 0: not yet
  int sent_after_fault = 0;  ///< permitted more than 100 ms after it
  bool is_read_in_fault = false;
  Random random{seed};

  bool is_faulty() const { return now_s >= fault_from_s; }
  bool has(ArmFault one) const { return fault == one && is_faulty(); }

  double force_n() const { return std::max(0.0, stiffness_n_per_m * (surface_m - tip.z())); }

  void note(const Verdict& verdict) {
    if (verdict.answer == Answer::Hold && held_at_s == 0.0) held_at_s = now_s;
  }

  void tell() {
    now_s += kTick_s;
    if (has(ArmFault::ClippedJoints)) tip.x() += 0.0005;
    most_n = std::max(most_n, force_n());
    if (!has(ArmFault::StalePose) && !has(ArmFault::KilledMaster)) {
      ArmPose pose = pose_at(tip, now_s);
      if (has(ArmFault::FrameChange)) pose.frame = "world";
      if (has(ArmFault::StampZero)) pose.stamp_s = 0.0;
      if (has(ArmFault::NotANumber)) pose.position.y() = std::nan("");
      if (has(ArmFault::ZeroQuaternion)) pose.quaternion.setZero();
      note(gate.hear(pose, now_s));
    }
    if (!has(ArmFault::StaleForce) && !has(ArmFault::KilledMaster)) {
      forces_n.push_back(force_n() + 1e-5 * random.normal());
      const int felt = std::max(0, static_cast<int>(forces_n.size()) - 1 - late_ticks);
      if (!has(ArmFault::StuckForce)) last_n = forces_n[static_cast<std::size_t>(felt)];
      note(gate.hear(ArmForce{now_s - late_ticks * kTick_s, last_n}, now_s));
    }
    if (!has(ArmFault::KilledMaster)) {
      ArmCondition condition{now_s, has(ArmFault::StateFault) ? "FAULT" : "ENABLED",
                             !has(ArmFault::Unhomed), false};
      note(gate.hear(condition, now_s));
    }
    if (has(ArmFault::Failure)) note(gate.hear_failure("goal_reached(false)"));
    note(gate.watch(now_s));
  }

  /// One set point towards a height; whether it was permitted.
  bool send(Phase phase, double z, double speed) {
    tell();
    Vec3 goal = tip;
    goal.z() += std::clamp(z - tip.z(), -0.95 * speed * kTick_s, 0.95 * speed * kTick_s);
    const Verdict verdict = gate.permit(phase, pose_at(goal, now_s), now_s);
    note(verdict);
    last = verdict;
    if (!verdict.is_go()) return false;
    if (now_s > fault_from_s + 0.1) ++sent_after_fault;
    if (!has(ArmFault::ClippedJoints)) tip = goal;
    return true;
  }

  /// As far as it is permitted; true at the goal, or in search at contact.
  bool go(Phase phase, double z, double speed) {
    for (int i = 0; i < 2000; ++i) {
      if (phase == Phase::Search && gate.is_touching()) return true;
      if (std::abs(tip.z() - z) < 1e-9) return true;
      if (!send(phase, z, speed)) return last.answer == Answer::Touches;
    }
    return false;
  }

  /// A whole touch; whether a reading was allowed, and how much force it was of.
  bool touch(const GateStop& stop) {
    tell();
    const Verdict begun = gate.begin(stop, now_s);
    note(begun);
    last = begun;
    if (!begun.is_go()) return false;
    bool is_read = false;
    if (go(Phase::Air, stop.standoff_m, 0.03) && go(Phase::Search, -0.05, 0.005) &&
        go(Phase::Press, tip.z() - stop.indent_m, 0.005)) {
      tell();
      const Verdict reading = gate.reading_allowed(now_s);
      note(reading);
      is_read = reading.is_go();
      is_read_in_fault |= is_read && now_s > fault_from_s + 0.1;
    }
    for (int i = 0; i < 50 && has(fault); ++i) send(Phase::Retract, stop.standoff_m, 0.005);
    if (gate.held_for().empty()) go(Phase::Retract, stop.standoff_m, 0.005);
    note(gate.finish(now_s));
    return is_read;
  }

  /// The fault is over, a person has looked and taken the tip up: a whole touch.
  bool goes_on(const GateStop& stop) {
    fault = ArmFault::None;
    tip = stop.surface + 0.006 * stop.normal;
    for (int i = 0; i < 10; ++i) tell();
    return gate.acknowledge(now_s).is_go() && touch(stop) && gate.held_for().empty();
  }

  std::vector<double> forces_n{};
  double last_n = 0.0;
  Verdict last{};
};

inline SimulatedArm arm_over(GateLimits limits) {
  return {.gate = Gate(std::move(limits), [](const Vec3& place) { return place.z(); })};
}

}  // namespace palpation
