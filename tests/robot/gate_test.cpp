#include "palpation/robot/gate.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "palpation/base/error.h"
#include "robot/gate_play.h"
#include "robot/simulated_arm.h"

namespace palpation {
namespace {

const GateStop kStop{Vec3::Zero(), Vec3::UnitZ(), 0.002, 0.005};

/// A gate that has heard all it asks for, and where a touch has begun.
struct Begun {
  Gate gate{play_limits(), [](const Vec3& place) { return place.z(); }};
  double now_s = 1.0;

  Begun() { tell(0.005); }
  void tell(double z, double force_n = 0.0) {
    now_s += kTick_s;
    gate.hear(pose_at(Vec3(0, 0, z), now_s), now_s);
    gate.hear(ArmForce{now_s, force_n + 1e-6 * now_s}, now_s);
    gate.hear(ArmCondition{now_s, "ENABLED", true, false}, now_s);
  }
  Verdict ask(Phase phase, const Vec3& where, const Vec3& axis = -Vec3::UnitZ()) {
    now_s += kTick_s;
    return gate.permit(phase, pose_at(where, now_s, axis), now_s);
  }
  /// To the tissue, which the tip touches there.
  void search() {
    gate.begin(kStop, now_s);
    for (int step = 0; step <= 100; ++step) {
      const double z = 0.005 - 0.00005 * step;
      EXPECT_TRUE(ask(Phase::Search, Vec3(0, 0, z)).is_go()) << gate.held_for();
      tell(z, step == 100 ? 0.2 : 0.0);
    }
    EXPECT_TRUE(gate.is_touching());
  }
};

TEST(Gate, LetsAWholeTouchThrough) {
  SimulatedArm arm = arm_over(play_limits());
  EXPECT_TRUE(arm.touch(kStop)) << arm.last.words << arm.gate.held_for();
  EXPECT_TRUE(arm.gate.held_for().empty()) << arm.gate.held_for();
  EXPECT_FALSE(arm.gate.is_under_way());
  EXPECT_TRUE(arm.touch(kStop));  // and another one
}

TEST(Gate, EveryRefusalNamesItsFigures) {
  const auto refused = [](const std::function<Verdict(Begun&)>& ask, const std::string& words) {
    Begun begun;
    begun.gate.begin(kStop, begun.now_s);
    const Verdict verdict = ask(begun);
    EXPECT_EQ(verdict.answer, Answer::Hold) << words;
    EXPECT_NE(verdict.words.find(words), std::string::npos) << verdict.words;
  };
  const auto at = [](Phase phase, const Vec3& where, const Vec3& axis = -Vec3::UnitZ()) {
    return [=](Begun& begun) { return begun.ask(phase, where, axis); };
  };
  refused(at(Phase::Air, Vec3(0, 0, 0.007)), "a step of 2 mm, more than 1 mm");
  refused(at(Phase::Air, Vec3(0, 0, 0.0058)), "a step of 0.8 mm in 10 ms, faster than 30 mm/s");
  refused(at(Phase::Search, Vec3(0, 0, 0.0049)), "faster than 5 mm/s at the tissue");
  refused(at(Phase::Press, Vec3(0, 0, 0.00496)), "a press before the tip has touched");
  refused(at(Phase::Retract, Vec3(0, 0, 0.00496)), "a retreat that goes 0.04 mm deeper");
  refused(at(Phase::Air, Vec3(0, 0, 0.005), Vec3(1, 0, -0.3).normalized()), "a turn of ");
  refused(
      [](Begun& begun) {
        begun.now_s += 0.1;
        return begun.gate.permit(Phase::Air, pose_at(Vec3(0, 0, 0.005), begun.now_s), begun.now_s);
      },
      "the last pose is 100 ms old, more than 50 ms");
  refused(
      [](Begun& begun) {
        ArmPose pose = pose_at(Vec3(0, 0, 0.005), begun.now_s);
        pose.frame = "PSM2_base";
        return begun.gate.permit(Phase::Air, pose, begun.now_s);
      },
      "a pose in the frame 'PSM2_base', not in 'PSM1_base'");
  refused(
      [](Begun& begun) {
        return begun.gate.hear(ArmForce{begun.now_s, 5.5}, begun.now_s);
      },
      "the force is 5.5 N, the limit 5 N");
  refused(
      [](Begun& begun) {
        return begun.gate.hear(ArmCondition{begun.now_s, "PAUSED", true, false}, begun.now_s);
      },
      "the arm is PAUSED, not ENABLED");
}

TEST(Gate, WhoWaitedMayNotJump) {
  Begun begun;
  begun.gate.begin(kStop, begun.now_s);
  EXPECT_TRUE(begun.ask(Phase::Air, Vec3(0, 0, 0.005)).is_go());
  for (int i = 0; i < 30; ++i) begun.tell(0.005);
  const Verdict jump = begun.ask(Phase::Search, Vec3(0, 0, 0.0047));  // 5 mm/s for 60 ms of 310
  EXPECT_EQ(jump.answer, Answer::Hold);
  EXPECT_NE(jump.words.find("a step of 0.3 mm in 50 ms, faster than 5 mm/s"), std::string::npos)
      << jump.words;
}

TEST(Gate, ATimeThatGoesBackIsAHoldUntilAllIsHeardAgain) {
  Begun begun;
  begun.gate.begin(kStop, begun.now_s);
  EXPECT_TRUE(begun.ask(Phase::Air, Vec3(0, 0, 0.005)).is_go());
  begun.now_s -= 0.5;
  const Verdict back = begun.ask(Phase::Air, Vec3(0, 0, 0.005));
  EXPECT_EQ(back.answer, Answer::Hold);
  EXPECT_NE(back.words.find("the time went back by 490 ms"), std::string::npos) << back.words;
  EXPECT_NE(begun.gate.acknowledge(begun.now_s).words.find("has not said where it is"),
            std::string::npos);
  begun.gate.hear(pose_at(Vec3(0, 0, 0.005), begun.now_s), begun.now_s);
  begun.gate.hear(ArmForce{begun.now_s, 0.0}, begun.now_s);  // its state it says when it changes
  EXPECT_TRUE(begun.gate.acknowledge(begun.now_s).is_go());
  EXPECT_EQ(begun.gate.watch(std::nan("")).answer, Answer::Hold);
}

TEST(Gate, ASearchBeginsInTheAirSinceContactIsWhereTheForceRises) {
  Begun begun;
  begun.tell(-0.001, 0.3);  // as after a hold, in the tissue
  begun.gate.begin(kStop, begun.now_s);
  const Verdict deeper = begun.ask(Phase::Search, Vec3(0, 0, -0.00104));
  EXPECT_EQ(deeper.answer, Answer::Hold);
  EXPECT_NE(deeper.words.find("begins in the tissue: go back first"), std::string::npos);
}

TEST(Gate, ATipDeeperThanItWasSentIsAHold) {
  Begun begun;
  begun.search();
  for (double z = 0.0; z > -0.0029; z -= 0.00004) {
    begun.tell(z, 0.2 - 100.0 * z);
    ASSERT_TRUE(begun.ask(Phase::Press, Vec3(0, 0, z - 0.00004)).is_go()) << z;
  }
  begun.tell(-0.0034, 0.6);
  EXPECT_EQ(begun.gate.held_for(), "");
  begun.tell(-0.0036, 0.7);
  EXPECT_NE(begun.gate.held_for().find("3.6 mm deeper than where it touched, more than 3.5 mm"),
            std::string::npos)
      << begun.gate.held_for();
}

TEST(Gate, AStopBeginsOnlyWhereItCanEnd) {
  const auto refused = [](GateStop stop, GateLimits limits, const std::string& words) {
    Begun begun;
    begun.gate = Gate(limits, [](const Vec3& place) { return place.z(); });
    begun.tell(0.01);
    const Verdict verdict = begun.gate.begin(stop, begun.now_s);
    EXPECT_EQ(verdict.answer, Answer::Hold);
    EXPECT_NE(verdict.words.find(words), std::string::npos) << verdict.words;
  };
  GateStop outside = kStop;
  outside.surface.x() = 0.031;
  refused(outside, play_limits(), "outside of the box");
  GateStop bent = kStop;
  bent.normal *= 1.1;
  refused(bent, play_limits(), "no unit vector");
  GateLimits unsure = play_limits();
  unsure.uncertainty_m = 0.0045;
  refused(kStop, unsure, "the tissue may lie 4.5 mm from where it is taken to be");
}

TEST(Gate, AfterAHoldNothingIsPermittedUntilAPersonAcknowledges) {
  Begun begun;
  begun.gate.begin(kStop, begun.now_s);
  begun.gate.hear_failure("goal_reached(false)");
  for (const Phase phase : {Phase::Air, Phase::Search, Phase::Press, Phase::Retract}) {
    begun.tell(0.005);
    EXPECT_EQ(begun.ask(phase, Vec3(0, 0, 0.005)).answer, Answer::Hold);
  }
  EXPECT_EQ(begun.gate.begin(kStop, begun.now_s).answer, Answer::Hold);
  begun.now_s += 1.0;
  const Verdict early = begun.gate.acknowledge(begun.now_s);
  EXPECT_NE(early.words.find("it cannot go on: the last pose is "), std::string::npos);
  begun.tell(0.005);
  EXPECT_TRUE(begun.gate.acknowledge(begun.now_s).is_go());
  EXPECT_TRUE(begun.gate.begin(kStop, begun.now_s).is_go());
}

TEST(Gate, FromTheWarningForceOnTheTipOnlyGoesBack) {
  Begun begun;
  begun.search();
  begun.tell(0.0, 2.5);
  const Verdict deeper = begun.ask(Phase::Press, Vec3(0, 0, -0.00001));
  EXPECT_EQ(deeper.answer, Answer::Retract);
  EXPECT_NE(deeper.words.find("the force was 2.5 N"), std::string::npos);
  begun.tell(0.0, 0.5);  // that it fell does not count
  EXPECT_EQ(begun.ask(Phase::Press, Vec3(0, 0, -0.00001)).answer, Answer::Retract);
  EXPECT_TRUE(begun.ask(Phase::Retract, Vec3(0, 0, 0.00001)).is_go());
}

TEST(Gate, ASearchWithoutContactEndsInWordsAndARetreat) {
  SimulatedArm arm = arm_over(play_limits());
  arm.surface_m = -0.01;
  EXPECT_FALSE(arm.touch(kStop));
  EXPECT_TRUE(arm.gate.held_for().empty()) << arm.gate.held_for();
  EXPECT_GE(arm.tip.z(), 0.0);
}

TEST(Gate, UncertaintyWidensTheSearchAndNoLimitAfterContact) {
  for (const double uncertainty_m : {0.0005, 0.001, 0.003}) {
    GateLimits limits = play_limits();
    limits.uncertainty_m = uncertainty_m;
    SimulatedArm arm = arm_over(limits);
    arm.surface_m = -0.9 * uncertainty_m;
    EXPECT_TRUE(arm.touch(kStop)) << arm.gate.held_for();
    // Pressed by hand: 3 mm from contact and no more, wherever the contact was.
    arm = arm_over(limits);
    arm.surface_m = -0.9 * uncertainty_m;
    arm.tell();
    arm.gate.begin(kStop, arm.now_s);
    ASSERT_TRUE(arm.go(Phase::Air, 0.005, 0.03) && arm.go(Phase::Search, -0.05, 0.005));
    const double contact_m = arm.tip.z();
    EXPECT_FALSE(arm.go(Phase::Press, -0.05, 0.005));
    EXPECT_NEAR(contact_m - arm.tip.z(), 0.003, 0.0002);
    EXPECT_NE(arm.gate.held_for().find("an indentation of"), std::string::npos);
  }
}

TEST(Gate, TheForceStaysBelowItsLimitOnStiffTissueThatIsNotWhereItIsTakenToBe) {
  // 1 mm of the surface and 2 mm of the registration, either way; 5 N/mm; the force 40 ms late.
  for (const double off_m : {-0.003, -0.001, 0.0, 0.001, 0.003}) {
    GateLimits limits = play_limits();
    limits.uncertainty_m = 0.003;
    SimulatedArm arm = arm_over(limits);
    arm.tip.z() = 0.008;
    arm.surface_m = off_m;
    arm.stiffness_n_per_m = 5000.0;
    arm.late_ticks = 4;
    arm.touch({Vec3::Zero(), Vec3::UnitZ(), 0.002, 0.006});
    EXPECT_LE(arm.most_n, limits.force.warn_n + 5000.0 * 0.005 * limits.data_age_s) << off_m;
    EXPECT_GT(arm.most_n, 0.1) << off_m;
    EXPECT_TRUE(arm.gate.held_for().empty()) << off_m << ": " << arm.gate.held_for();
  }
}

TEST(Gate, EveryFaultIsHeldWithinATenthOfASecondAndNothingIsSentAfter) {
  Random random(3);
  for (int fault = 1; fault <= static_cast<int>(ArmFault::KilledMaster); ++fault) {
    int held = 0;
    for (int run = 0; run < 1000; ++run) {
      SimulatedArm arm = arm_over(play_limits());
      arm.fault = static_cast<ArmFault>(fault);
      arm.seed = static_cast<std::uint64_t>(run);
      // A touch takes 2.9 s; a sensor is found stuck only while the tip moves in search or
      // pressing.
      arm.fault_from_s = arm.fault == ArmFault::StuckForce ? 1.1 + 1.1 * random.uniform()
                                                           : 1.03 + 1.8 * random.uniform();
      arm.touch(kStop);
      if (arm.held_at_s == 0.0) continue;  // it was over before
      ++held;
      double due_s = arm.fault_from_s + 0.1 + kTick_s;
      // 0.5 mm a tick, 2 mm are too far.
      ASSERT_LE(arm.held_at_s, due_s) << "fault " << fault << ": " << arm.gate.held_for();
      ASSERT_EQ(arm.sent_after_fault, 0) << "fault " << fault;
      ASSERT_FALSE(arm.gate.held_for().empty());
      ASSERT_FALSE(arm.is_read_in_fault) << "fault " << fault;
      ASSERT_TRUE(arm.goes_on(kStop)) << "fault " << fault << ": " << arm.gate.held_for();
    }
    EXPECT_GT(held, 900) << "fault " << fault;
  }
}

TEST(Gate, NothingGoesOutThatItsLawsForbidWhateverItIsTold) {
  int permitted = 0, pressed = 0;
  for (const double mischief : {0.0005, 0.005, 0.1}) {
    const GatePlay::Counts counts = GatePlay(7, mischief).play(35'000);
    EXPECT_EQ(counts.fault, "") << mischief;
    permitted += counts.permitted;
    pressed += counts.pressed;
    EXPECT_GT(counts.held, 20) << mischief;
  }
  EXPECT_GT(permitted, 60'000);
  EXPECT_GT(pressed, 5'000);
}

TEST(GateLimits, ThatCannotBeKeptAreRefused) {
  check(play_limits());
  for (const auto& spoil : std::vector<std::function<void(GateLimits&)>>{
           [](GateLimits& one) { one.force.warn_n = 6.0; },
           [](GateLimits& one) { one.force.stiffest_n_per_m = 20'000.0; },
           [](GateLimits& one) { one.motion.contact_m_per_s = 0.02; },
           [](GateLimits& one) { one.data_age_s = std::nan(""); },
           [](GateLimits& one) { one.motion.step_m = 0.0; },
           [](GateLimits& one) { one.cone.axis_rad = 1.6; },
           [](GateLimits& one) { one.box_most = one.box_least; },
           [](GateLimits& one) { one.box_most.x() = INFINITY; },
           [](GateLimits& one) { one.uncertainty_m = -1.0; }}) {
    GateLimits limits = play_limits();
    spoil(limits);
    EXPECT_THROW(check(limits), InvalidInput);
  }
}

}  // namespace
}  // namespace palpation
