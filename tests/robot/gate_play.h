/// A driver that knows how to touch, and every now and then does not: what it is permitted is held
/// against the laws of the gate by figures of its own.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "palpation/base/random.h"
#include "palpation/robot/gate.h"

namespace palpation {

inline constexpr double kTick_s = 0.010;

inline GateLimits play_limits() {
  GateLimits limits;
  limits.box_least = Vec3(-0.03, -0.03, -0.02);
  limits.box_most = Vec3(0.03, 0.03, 0.05);
  limits.frame = "PSM1_base";
  return limits;
}

/// The tissue as it is taken to be: a gentle hill.
inline double play_height(const Vec3& place) {
  return place.z() - 0.002 * std::exp(-(place.x() * place.x() + place.y() * place.y()) / 1e-4);
}

inline ArmPose pose_at(const Vec3& position, double stamp_s, const Vec3& axis = -Vec3::UnitZ()) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis);
  return {stamp_s, "PSM1_base", position, turn.coeffs()};
}

/// What went out, and why it must not have; empty where it may.
class Oracle {
 public:
  explicit Oracle(GateLimits limits) : limits_(std::move(limits)) {}

  void begins(const GateStop& stop, double now_s) {
    stop_ = stop, has_sent_ = false, begun_s_ = now_s;
  }
  void hears(const ArmPose& pose, double now_s) {
    look_at_clock(now_s);
    const bool is_sound = pose.position.allFinite() && pose.frame == limits_.frame &&
                          std::abs(pose.quaternion.norm() - 1.0) < 0.01;
    if (is_sound && is_newer(pose.stamp_s, pose_.stamp_s, now_s)) pose_ = pose;
  }
  void hears(const ArmForce& force, double now_s) {
    look_at_clock(now_s);
    if (std::isfinite(force.force_n) && is_newer(force.stamp_s, force_.stamp_s, now_s))
      force_ = force;
  }
  void touches(const Vec3& tip) { contact_ = tip; }
  void holds() { is_held_ = true; }
  void is_acknowledged() { is_held_ = false; }

  std::string judge(Phase phase, const ArmPose& sent, double now_s) {
    std::string fault;
    const auto deny = [&](bool is_wrong, const char* what) {
      if (is_wrong && fault.empty()) fault = what;
    };
    look_at_clock(now_s);
    const Vec3& p = sent.position;
    deny(is_held_, "after a hold");
    deny(!p.allFinite() || !sent.quaternion.allFinite(), "not finite");
    deny(sent.frame != limits_.frame, "another frame");
    deny((p - limits_.box_least).minCoeff() < 0 || (limits_.box_most - p).minCoeff() < 0, "box");
    deny(now_s - pose_.stamp_s > limits_.data_age_s, "an old pose");
    deny(now_s - force_.stamp_s > limits_.data_age_s, "an old force");
    deny(std::abs(force_.force_n) >= limits_.force.hold_n, "the force to hold at");
    deny(std::abs(force_.force_n) >= limits_.force.warn_n && phase != Phase::Retract,
         "the force to go back from");
    const Vec3 from = has_sent_ ? sent_.position : pose_.position;
    const double since_s = std::min(0.050, now_s - (has_sent_ ? sent_.stamp_s : begun_s_));
    const double step_m = (p - from).norm();
    deny(step_m > limits_.motion.step_m * 1.000001, "step");
    const double speed = phase == Phase::Air ? 0.030 : 0.005;
    deny(step_m > speed * since_s * 1.000001, "speed");
    const Vec3 away = p - stop_.surface;
    const double height_m = away.dot(stop_.normal);
    const Eigen::Matrix3d turn =
        Eigen::Quaterniond(Eigen::Vector4d(sent.quaternion.normalized())).toRotationMatrix();
    const double cosine = -turn.col(2).dot(stop_.normal);
    deny(cosine < std::cos(phase == Phase::Air ? 1.05 : 0.35) - 1e-6, "axis");
    if (phase == Phase::Air) {
      deny(play_height(p) < limits_.uncertainty_m, "low in the air");
    } else {
      const double wide_m = 0.001 + std::max(0.0, height_m) * std::tan(0.26);
      deny((away - height_m * stop_.normal).norm() > wide_m + 1e-8, "cone");
    }
    deny(phase == Phase::Search && -height_m > 0.002 + 1e-8, "search depth");
    deny(phase == Phase::Press && (contact_ - p).dot(stop_.normal) > stop_.indent_m + 0.001 + 1e-8,
         "indentation");
    sent_ = sent, sent_.stamp_s = now_s, has_sent_ = true;
    return fault;
  }

 private:
  /// What came before a clock went back is of no time.
  void look_at_clock(double now_s) {
    if (now_s < last_s_ - 0.005) pose_.stamp_s = force_.stamp_s = 0.0;
    last_s_ = now_s < last_s_ - 0.005 ? now_s : std::max(last_s_, now_s);
  }
  static bool is_newer(double stamp_s, double last_s, double now_s) {
    return stamp_s > 0.0 && stamp_s <= now_s + 0.005 && stamp_s >= last_s;
  }

  GateLimits limits_;
  GateStop stop_;
  ArmPose pose_, sent_;
  ArmForce force_;
  Vec3 contact_ = Vec3::Zero();
  double begun_s_ = 0.0, last_s_ = 0.0;
  bool has_sent_ = false, is_held_ = false;
};

/// Plays `commands` set points. What it counts tells that the play was one.
class GatePlay {
 public:
  explicit GatePlay(std::uint64_t seed, double mischief)
      : random_(seed),
        mischief_(mischief),
        gate_(play_limits(), play_height),
        oracle_(play_limits()) {}

  struct Counts {
    int commands = 0, permitted = 0, pressed = 0, held = 0, backwards = 0;
    std::string fault;  ///< the first
  };

  Counts play(int commands) {
    while (counts_.commands < commands && counts_.fault.empty()) touch();
    return counts_;
  }

 private:
  bool wild() { return random_.uniform() < mischief_; }
  double any() {
    const double values[] = {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(),
                             0.0,
                             -0.0,
                             1e300,
                             5e-324,
                             random_.normal(),
                             0.01 * random_.normal(),
                             0.0005 * random_.normal()};
    return values[random_.below(9)];
  }

  void tell_all() {
    now_ += kTick_s;
    ArmPose pose = pose_at(tip_, now_ - 0.001, axis_);
    if (random_.below(2) == 0) pose.quaternion = -pose.quaternion;
    if (wild()) spoil(pose);
    note(gate_.hear(pose, now_));
    oracle_.hears(pose, now_);
    const double pressed_m = -play_height(tip_) + lift_;
    ArmForce force{now_ - 0.001, std::max(0.0, 800.0 * pressed_m) + 1e-6 * random_.normal()};
    if (wild()) force.force_n = random_.below(2) == 0 ? any() : 6.0 * random_.uniform();
    if (wild()) force.stamp_s = any();
    const bool was_touching = gate_.is_touching();
    note(gate_.hear(force, now_));
    oracle_.hears(force, now_);
    if (!was_touching && gate_.is_touching()) oracle_.touches(last_pose_told_);
    ArmCondition condition{now_ - 0.001, "ENABLED", true, false};
    if (wild() && wild()) condition.state = random_.below(2) == 0 ? "FAULT" : "garbage";
    note(gate_.hear(condition, now_));
  }

  void spoil(ArmPose& pose) {
    switch (random_.below(6)) {
      case 0:
        pose.position[random_.below(3)] = any();
        break;
      case 1:
        pose.quaternion[random_.below(4)] = any();
        break;
      case 2:
        pose.quaternion.setZero();
        break;
      case 3:
        pose.frame = random_.below(2) == 0 ? "" : "PSM2_base";
        break;
      case 4:
        pose.stamp_s = any();
        break;
      default:
        pose.position += 0.01 * Vec3(random_.normal(), random_.normal(), random_.normal());
    }
  }

  bool note(const Verdict& verdict) {
    if (verdict.answer == Answer::Hold) oracle_.holds(), ++counts_.held;
    if (verdict.answer != Answer::Go && verdict.words.empty() && counts_.fault.empty())
      counts_.fault = "an answer without words";
    return verdict.answer != Answer::Hold;
  }

  /// One set point, as it should be or not: of one who waited and wants to make up for it, too.
  bool send(Phase phase, const Vec3& goal, double speed) {
    if (wild())
      for (int ticks = random_.below(12); ticks > 0; --ticks) tell_all();
    const Vec3 way = goal - tip_;
    const double greed = wild() ? 1.2 * random_.uniform() : 0.9;
    const double step_m =
        std::min(way.norm(), greed * speed * std::max(kTick_s, now_ - last_sent_s_));
    const Vec3 next = way.norm() > 0 ? Vec3(tip_ + step_m * way.normalized()) : tip_;
    if (wild()) now_ += 0.4 * random_.uniform() - 0.2;
    ArmPose set_point = pose_at(next, now_, axis_);
    if (wild()) spoil(set_point);
    if (wild()) phase = static_cast<Phase>(random_.below(4));
    const Verdict verdict = gate_.permit(phase, set_point, now_);
    ++counts_.commands;
    if (verdict.answer == Answer::Retract) ++counts_.backwards;
    note(verdict);
    if (!verdict.is_go()) return false;
    ++counts_.permitted;
    counts_.pressed += phase == Phase::Press ? 1 : 0;
    if (std::string fault = oracle_.judge(phase, set_point, now_);
        !fault.empty() && counts_.fault.empty())
      counts_.fault = fault + ", in command " + std::to_string(counts_.commands);
    tip_ = set_point.position;
    last_sent_s_ = now_;
    return true;
  }

  /// Sends set points until the goal, or until one is not permitted.
  bool go(Phase phase, const Vec3& goal, double speed) {
    for (int i = 0; i < 3000 && (goal - tip_).norm() > 1e-9; ++i) {
      last_pose_told_ = tip_;
      tell_all();
      if (phase == Phase::Search && gate_.is_touching()) return true;
      if (!send(phase, goal, speed)) return false;
      if (!counts_.fault.empty()) return false;
    }
    return true;
  }

  void touch() {
    lift_ = 0.0015 * (2.0 * random_.uniform() - 1.0);
    GateStop stop;
    stop.surface = Vec3(0.02 * (random_.uniform() - 0.5), 0.02 * (random_.uniform() - 0.5), 0.0);
    stop.surface.z() = -play_height(stop.surface);
    stop.normal = Vec3(0.1 * random_.normal(), 0.1 * random_.normal(), 1.0).normalized();
    if (wild()) stop.normal[random_.below(3)] = any();
    if (wild()) stop.surface[random_.below(3)] = any();
    axis_ = stop.normal.allFinite() ? Vec3(-stop.normal.normalized()) : Vec3(-Vec3::UnitZ());
    tip_ = stop.surface.allFinite() ? Vec3(stop.surface + 0.006 * stop.normal) : Vec3::Zero();
    if (!tip_.allFinite() || tip_.norm() > 1.0) tip_ = Vec3(0, 0, 0.02);
    last_pose_told_ = tip_;
    tell_all();
    last_sent_s_ = now_;
    const Verdict begun = gate_.begin(stop, now_);
    note(begun);
    if (begun.is_go()) {
      oracle_.begins(stop, now_);
      const Vec3 approach = stop.surface + 0.005 * stop.normal;
      const Vec3 down = stop.surface - 0.01 * stop.normal;
      const bool is_down = go(Phase::Air, approach, 0.03) && go(Phase::Search, down, 0.005) &&
                           go(Phase::Press, Vec3(tip_ - 0.002 * stop.normal), 0.005);
      if (is_down) note(gate_.reading_allowed(now_));
      go(Phase::Retract, approach, 0.005);
      note(gate_.finish(now_));
    }
    // A person looks; without one nothing is permitted, however often it is asked for.
    if (gate_.held_for().empty()) return;
    for (int i = 0; i < 3; ++i) {
      tell_all();
      send(static_cast<Phase>(random_.below(4)), tip_, 0.005);
    }
    for (int i = 0; i < 20 && !gate_.held_for().empty(); ++i) {
      tell_all();
      if (gate_.acknowledge(now_).is_go()) oracle_.is_acknowledged();
    }
  }

  Random random_;
  double mischief_;
  Gate gate_;
  Oracle oracle_;
  Counts counts_;
  double now_ = 1.0, last_sent_s_ = 1.0, lift_ = 0.0;
  Vec3 tip_ = Vec3::Zero(), last_pose_told_ = Vec3::Zero(), axis_ = -Vec3::UnitZ();
};

}  // namespace palpation
