#include "palpation/probing/probings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "palpation/base/error.h"
#include "palpation/base/random.h"
#include "palpation/probing/scan.h"

namespace palpation {
namespace {

constexpr double kStiffness = 500.0;  // N/m
const Vec3 kOutward = Vec3(0.3, -0.2, 1.0).normalized();

/// Presses 10 mm apart along x, a sample each 0.2 mm, on tissue whose normal is tilted: `air`
/// samples before contact, as many back out as in.
RobotLog presses(int count, int air, double noise_n = 0.0) {
  RobotLog log;
  Random random(1);
  const int in = 12, each = 2 * (air + in);
  log.position_m.resize(count * each, 3);
  log.force.resize(count * each, 3);
  log.time_s.resize(count * each);
  for (int i = 0; i < count * each; ++i) {
    const int at = i % each, down = std::min(at, each - 1 - at) - air;
    const double past_m = 2e-4 * down;
    const Vec3 place = Vec3(0.01 * (i / each), 0.0, 0.0) - past_m * kOutward;
    const double force_n = kStiffness * std::max(0.0, past_m) + noise_n * random.normal();
    log.position_m.row(i) = place;
    log.force.row(i) = force_n * kOutward;
    log.time_s[i] = 0.02 * i;
    log.line.push_back(i + 2);
  }
  return log;
}

void expect_presses(const ProbedLog& result, int count, double tolerance) {
  ASSERT_EQ(static_cast<int>(result.probed.size()), count);
  for (int i = 0; i < count; ++i) {
    const Probed& probed = result.probed[static_cast<std::size_t>(i)];
    EXPECT_EQ(probed.reason, "");
    EXPECT_NEAR(probed.reading, 0.5, tolerance);
    EXPECT_NEAR((probed.place_m - Vec3(0.01 * i, 0.0, 0.0)).norm(), 0.0, 2e-4);
    EXPECT_NEAR(probed.normal.dot(kOutward), 1.0, 1e-6);
  }
}

TEST(ProbingReadings, FindsPressesByContact) {
  const ProbedLog result = probing_readings(presses(5, 15, 0.005));
  expect_presses(result, 5, 0.02);
  EXPECT_EQ(result.unit, "N/mm");
  EXPECT_EQ(result.probed[0].contact, "from the air");
}

// Three samples before contact tell no approach by themselves; what was found by contact has one.
TEST(ProbingReadings, FindsPressesByContactFromLittleAir) {
  RobotLog log = presses(5, 3, 0.002);
  for (Eigen::Index i = 0; i < log.size(); ++i)
    log.time_s[i] += 3.0 * double(i / 30);  // not logged
  expect_presses(probing_readings(log), 5, 0.03);
}

// The way from one place to the next, 10 mm in one step, is no approach.
TEST(ProbingReadings, BeginsAnApproachWhereTheProbeCameFrom) {
  const ProbedLog result = probing_readings(presses(5, 8, 0.002));
  expect_presses(result, 5, 0.03);
  for (const Probed& probed : result.probed) EXPECT_EQ((probed.line - 2) % 40, 0) << probed.line;
}

// The sensor ends at .93 N, which the last two samples of the softer press reach: alone, they could
// be anything; others that stay there say what they are.
TEST(ProbingReadings, LearnsTheSensorsLimitFromAllPresses) {
  RobotLog log = presses(4, 15, 0.002);
  log.names = {"a", "b", "c", "d"};
  for (Eigen::Index i = 0; i < log.size(); ++i) {
    log.probing.push_back(static_cast<int>(i / 54));
    const double force_n = log.force.row(i).dot(kOutward) * (i / 54 == 3 ? 1.0 : 2.0);
    log.force.row(i) = std::min(force_n, 0.93) * kOutward;
  }
  const ProbedLog result = probing_readings(log);
  EXPECT_NEAR(result.probed[0].reading, 1.0, 0.02);
  EXPECT_NEAR(result.probed[3].reading, 0.5, 0.01);
}

// Two presses that stay at one force tell no limit where a third goes beyond it.
TEST(ProbingReadings, TakesNoForceForALimitThatAnotherPressExceeds) {
  RobotLog log = presses(4, 15, 0.002);
  log.names = {"a", "b", "c", "d"};
  for (Eigen::Index i = 0; i < log.size(); ++i) {
    log.probing.push_back(static_cast<int>(i / 54));
    const double force_n = log.force.row(i).dot(kOutward) * 2.0;
    log.force.row(i) = (i / 54 < 2 ? std::min(force_n, 0.93) : force_n) * kOutward;
  }
  const ProbedLog result = probing_readings(log);
  for (const Probed& probed : result.probed) EXPECT_NEAR(probed.reading, 1.0, 0.02);
  const auto told = std::ranges::find_if(result.remarks, [](const std::string& remark) {
    return remark.find("samples were left out") != std::string::npos;
  });
  ASSERT_NE(told, result.remarks.end());
  EXPECT_EQ(*told, "14 samples were left out: not finite, far off their fit, or saturated.");
}

TEST(ProbingReadings, CountsEitherWay) {
  const RobotLog log = presses(3, 15);
  RobotLog against = log;
  against.force *= -1.0;
  expect_presses(probing_readings(against), 3, 1e-3);
  against = log;
  against.normal = Points::Zero(log.size(), 3);
  against.normal.rowwise() = -kOutward.transpose();  // into the tissue
  expect_presses(probing_readings(against), 3, 1e-3);
}

TEST(ProbingReadings, TakesNamesInAnyOrder) {
  RobotLog log = presses(3, 15);
  log.names = {"a", "b", "c"};
  for (Eigen::Index i = 0; i < log.size(); ++i) log.probing.push_back(static_cast<int>(i / 54));
  std::swap(log.probing[53], log.probing[54]);  // a row that was swapped with the next probing's
  const ProbedLog result = probing_readings(log);
  ASSERT_EQ(result.probed.size(), 3u);
  EXPECT_EQ(result.probed[2].probing, "c");
  EXPECT_NEAR(result.probed[2].reading, 0.5, 1e-3);
}

TEST(ProbingReadings, UsesTheContactPointThatTheLogNames) {
  RobotLog log = presses(2, 15);
  log.contact_m = Points::Constant(log.size(), 3, 0.07);
  const ProbedLog result = probing_readings(log);
  EXPECT_EQ(result.probed[1].place_m, Vec3(0.07, 0.07, 0.07));
}

TEST(ProbingReadings, TellsAMissedStopFromAFailedOne) {
  RobotLog log = presses(4, 15, 0.005);
  log.names = {"a", "b", "c", "d"};
  Random random(7);
  for (Eigen::Index i = 0; i < log.size(); ++i) {
    log.probing.push_back(static_cast<int>(i / 54));
    if (i / 54 == 1) log.force.row(i) = 0.005 * random.normal() * kOutward;
    if (i / 54 == 2) log.force.row(i).setConstant(0.5);
  }
  const ProbedLog result = probing_readings(log);
  EXPECT_TRUE(result.probed[1].is_missed) << result.probed[1].reason << result.probed[1].reading;
  EXPECT_EQ(result.probed[1].contact, "none");
  // Where it was deepest: eleven steps past the plane where the others met the tissue.
  EXPECT_NEAR((result.probed[1].place_m - Vec3(0.01, 0.0, 0.0) + 2.2e-3 * kOutward).norm(), 0.0,
              1e-12);
  EXPECT_FALSE(result.probed[2].is_missed);
  EXPECT_NE(result.probed[2].reason.find("stuck"), std::string::npos);
  EXPECT_NEAR(result.probed[3].reading, 0.5, 0.02);
}

/// A drag at 0.1 mm a sample; counts that rise along the way.
RobotLog dragged(double noise, Random& random) {
  RobotLog log;
  log.position_m = Points::Zero(2000, 3);
  log.force_along.resize(2000);
  log.force_unit = "counts";
  for (Eigen::Index i = 0; i < 2000; ++i) {
    log.position_m(i, 1) = 1e-4 * double(i);
    log.force_along[i] = 7000.0 + double(i) + noise * random.normal();
    log.line.push_back(static_cast<int>(i) + 2);
  }
  return log;
}

TEST(ScanReadings, StatesTheErrorOfItsMeansHonestly) {
  Random random(1);
  int inside = 0, all = 0;
  for (int draw = 0; draw < 5; ++draw) {
    const ProbedLog result = scan_readings(dragged(20.0, random));
    EXPECT_EQ(result.unit, "counts");
    for (const Probed& probed : result.probed) {
      const double truth = 7000.0 + probed.place_m.y() * 1e4;
      if (std::isnan(probed.noise_variance)) continue;  // the last few samples
      inside += std::abs(probed.reading - truth) <= 2.0 * std::sqrt(probed.noise_variance);
      ++all;
      EXPECT_NEAR(probed.travel.y(), 1.0, 1e-12);
    }
  }
  EXPECT_GE(all, 800);
  EXPECT_GE(double(inside) / all, 0.90);
  EXPECT_LE(double(inside) / all, 0.985);
}

TEST(ScanReadings, StatesNoErrorBehindASlowFilter) {
  Random random(1);
  RobotLog log = dragged(20.0, random);
  for (Eigen::Index i = 1; i < log.size(); ++i)
    log.force_along[i] = 0.95 * log.force_along[i - 1] + 0.05 * log.force_along[i];
  for (const Probed& probed : scan_readings(log).probed)
    EXPECT_TRUE(std::isnan(probed.noise_variance)) << scan_readings(log).remarks[0];
}

TEST(ScanReadings, LeavesOutASensorThatHangs) {
  Random random(1);
  RobotLog log = dragged(20.0, random);
  log.force_along.segment(500, 300).setConstant(7430.0);
  int stuck = 0;
  for (const Probed& probed : scan_readings(log).probed) stuck += !probed.reason.empty();
  EXPECT_NEAR(stuck, 30, 4);  // millimetres, less those that begin or end outside
}

TEST(ScanReadings, BreaksAtJumps) {
  Random random(1);
  RobotLog log = dragged(0.0, random);
  log.position_m.bottomRows(1005).array() += 0.1;
  for (const Probed& probed : scan_readings(log).probed)
    EXPECT_TRUE(probed.place_m.y() <= 0.0995 || probed.place_m.y() >= 0.1995);
}

TEST(Probing, RefusesWhatIsNoLog) {
  EXPECT_THROW(probing_readings(RobotLog{}), InvalidInput);
  EXPECT_THROW(scan_readings(RobotLog{}), InvalidInput);
  Random random(1);
  EXPECT_THROW(scan_readings(dragged(1.0, random), {.every_m = 0.0}), InvalidInput);
}

}  // namespace
}  // namespace palpation
