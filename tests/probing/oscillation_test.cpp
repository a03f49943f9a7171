#include "palpation/probing/oscillation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "palpation/base/error.h"
#include "palpation/base/random.h"

namespace palpation {
namespace {

constexpr double kStiffness = 450.0;  // N/m

struct Ride {
  double frequency_hz = 2.0, rate_hz = 67.0, seconds = 60.0;
  double force_noise_n = 0.0, position_noise_m = 0.0;
  double force_drift_n = 0.0;    ///< a slow wander
  double damping = 0.0;          ///< of the stiffness, in quadrature
  double stiffness_slope = 0.0;  ///< of itself, per second
};

/// A probe that slides at 3 mm/s over a bowl, its normal tilted, pressed in by 1 mm up and down.
RobotLog ridden(const Ride& ride, Random& random) {
  const auto n = static_cast<Eigen::Index>(ride.seconds * ride.rate_hz);
  RobotLog log;
  log.time_s.resize(n);
  log.position_m.resize(n, 3);
  log.force.resize(n, 3);
  const Vec3 normal = Vec3(0.2, 0.1, 1.0).normalized();
  for (Eigen::Index i = 0; i < n; ++i) {
    log.line.push_back(static_cast<int>(i) + 2);
    const double t = (double(i) + 0.3 * random.uniform()) / ride.rate_hz;
    const double angle = 2.0 * std::numbers::pi * ride.frequency_hz * t;
    const double out_m = -1e-3 * std::cos(angle);
    const double stiffness = kStiffness * (1.0 + ride.stiffness_slope * (t - 0.5 * ride.seconds));
    const double force_n = 1.2 - stiffness * out_m -
                           ride.damping * stiffness * 1e-3 * std::sin(angle) +
                           ride.force_drift_n * std::sin(0.5 * t);
    log.time_s[i] = t;
    const Vec3 path(0.003 * t, 0.01 * std::sin(0.3 * t), 0.008 * std::sin(0.4 * t));
    log.position_m.row(i) =
        path + normal * out_m +
        ride.position_noise_m * Vec3(random.normal(), random.normal(), random.normal());
    log.force.row(i) = force_n * normal +
                       ride.force_noise_n * Vec3(random.normal(), random.normal(), random.normal());
  }
  return log;
}

TEST(SlideReadings, GivesTheSpringUnderATravellingProbe) {
  Random random(1);
  const ProbedLog result = slide_readings(ridden({}, random));
  ASSERT_EQ(result.probed.size(), 30u);  // windows of two seconds
  EXPECT_EQ(result.unit, "N/mm");
  for (const Probed& probed : result.probed) {
    EXPECT_EQ(probed.reason, "");
    // What a cubic leaves of the travel near 2 Hz.
    EXPECT_NEAR(probed.reading, 0.45, 1e-3);
    EXPECT_NEAR(std::abs(probed.normal.dot(Vec3(0.2, 0.1, 1.0).normalized())), 1.0, 1e-6);
  }
}

TEST(SlideReadings, FindsTheFrequency) {
  Random random(1);
  for (const double hz : {1.3, 2.0, 3.7, 6.0}) {
    const std::vector<double> found =
        oscillations_in(ridden({.frequency_hz = hz, .force_noise_n = 0.02}, random));
    ASSERT_EQ(found.size(), 1u) << hz;
    EXPECT_NEAR(found[0], hz, 0.02);
  }
}

TEST(SlideReadings, StatesItsErrorHonestly) {
  for (const Ride& ride :
       {Ride{.force_noise_n = 0.05},
        Ride{.force_noise_n = 0.05, .position_noise_m = 5e-5, .force_drift_n = 0.3},
        Ride{.force_noise_n = 0.02, .damping = 0.3}}) {
    int inside = 0, all = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      Random random(seed);
      for (const Probed& probed : slide_readings(ridden(ride, random)).probed) {
        ASSERT_EQ(probed.reason, "");
        inside += std::abs(probed.reading - 0.45) <= 2.0 * std::sqrt(probed.noise_variance);
        ++all;
      }
    }
    EXPECT_GE(double(inside) / all, 0.93);  // of 600: one in a hundred is .009 from .957
    EXPECT_LE(double(inside) / all, 0.985);
  }
}

TEST(SlideReadings, OverlapMakesNoNewInformation) {
  Random random(1);
  const RobotLog log = ridden({.force_noise_n = 0.05}, random);
  const auto worth = [&](int step) {
    double sum = 0.0;
    for (const Probed& probed : slide_readings(log, {.step_periods = step}).probed)
      sum += 1.0 / probed.noise_variance;
    return sum;
  };
  EXPECT_NEAR(worth(1) / worth(4), 1.0, 0.25);  // of the variances' own scatter
}

TEST(SlideReadings, BreaksAtGaps) {
  Random random(1);
  RobotLog log = ridden({}, random);
  log.time_s.tail(log.size() / 2).array() += 10.3;
  const ProbedLog result = slide_readings(log, {.frequency_hz = 2.0});
  EXPECT_EQ(result.probed.size(), 29u);  // of thirty, one a half
  for (const Probed& probed : result.probed) EXPECT_NEAR(probed.reading, 0.45, 1e-3);
}

TEST(SlideReadings, SaysWhyAWindowGivesNone) {
  Random random(1);
  RobotLog log = ridden({.force_noise_n = 0.02}, random);
  for (Eigen::Index i = 0; i < log.size(); ++i) {
    const double t = log.time_s[i];
    if (t < 10.0) log.force.row(i) << 0.1, 0.2, 1.0;  // stuck
    if (t > 20.0 && t < 30.0)                         // in the air
      log.force.row(i) = 0.02 * Vec3(random.normal(), random.normal(), random.normal());
    if (t > 40.0 && t < 50.0)
      log.force.row(i) *= std::max(0.0, 1.0 - 1.2 / log.force(i, 2));  // bounces
  }
  const ProbedLog result = slide_readings(log, {.frequency_hz = 2.0});
  const auto reason_at = [&](double t) {
    for (const Probed& probed : result.probed)
      if (std::abs(probed.time_s - t) <= 1.0) return probed.reason;
    return std::string("no window");
  };
  EXPECT_EQ(reason_at(5.0), "the force is stuck");
  EXPECT_EQ(reason_at(15.0), "");
  EXPECT_NE(reason_at(25.0).find("no oscillation"), std::string::npos);
  EXPECT_EQ(reason_at(35.0), "");
  EXPECT_NE(reason_at(45.0).find("contact is lost"), std::string::npos);
}

TEST(SlideReadings, RefusesALogWithoutAnOscillation) {
  Random random(1);
  RobotLog log = ridden({.force_noise_n = 0.02}, random);
  for (Eigen::Index i = 0; i < log.size(); ++i)
    log.force.row(i) = 0.02 * Vec3(random.normal(), random.normal(), random.normal());
  for (Eigen::Index i = 0; i < log.size(); ++i)
    log.position_m.row(i) << 0.003 * log.time_s[i], 0.0, 0.0;
  EXPECT_THROW(slide_readings(log), InvalidInput);
  EXPECT_THROW(slide_readings(log, {.frequency_hz = 30.0}), InvalidInput);
  EXPECT_THROW(slide_readings(log, {.window_periods = 2}), InvalidInput);
  EXPECT_THROW(slide_readings(RobotLog{}), InvalidInput);
}

}  // namespace
}  // namespace palpation
