#include "palpation/probing/indentation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpation/base/error.h"
#include "palpation/base/random.h"

namespace palpation {
namespace {

/// What a sensor feels in one press from the air into the tissue, a sample each 0.1 mm and 20 ms.
struct Press {
  double air_mm = 0.0, deep_mm = 3.0;
  double zero_n = 0.0, drift_n_per_s = 0.0, noise_n = 0.0;
};

template <typename Force>
Indentation pressed(const Press& press, Force&& force_at_m, Random& random) {
  const int n = static_cast<int>(std::lround((press.air_mm + press.deep_mm) * 10.0)) + 1;
  Indentation made{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (int i = 0; i < n; ++i) {
    const double past_m = i * 1e-4 - press.air_mm * 1e-3;
    made.time_s[i] = i * 0.02;
    made.depth_m[i] = 0.010 + i * 1e-4;  // wherever the robot counts from
    made.force[i] = press.zero_n + press.drift_n_per_s * made.time_s[i] +
                    (past_m > 0.0 ? force_at_m(past_m) : 0.0) + press.noise_n * random.normal();
  }
  return made;
}

double spring(double past_m) { return 400.0 * past_m; }

constexpr double kRadius_m = 0.003;
double hertz(double past_m) {
  return 4.0 / 3.0 * 8000.0 * std::sqrt(kRadius_m) * std::pow(past_m, 1.5);
}

/// The share of draws whose true value lies within two stated standard deviations.
template <typename Force>
double held(const Press& press, Force&& force, double truth, const ContactOptions& options,
            int draws = 400) {
  int inside = 0;
  for (int draw = 0; draw < draws; ++draw) {
    Random random(static_cast<std::uint64_t>(draw));
    const ContactFit fit = fit_contact(pressed(press, force, random), options);
    EXPECT_EQ(fit.outcome, ContactOutcome::Fitted) << fit.reason;
    inside += std::abs(fit.value - truth) <= 2.0 * std::sqrt(fit.variance);
  }
  return static_cast<double>(inside) / draws;
}

void expect_honest(double share) {
  EXPECT_GE(share, 0.90);
  EXPECT_LE(share, 0.985);
}

TEST(FitContact, GivesTheSpringOfALineExactly) {
  Random random(1);
  const ContactFit fit = fit_contact(pressed({.zero_n = 0.7}, spring, random));
  EXPECT_EQ(fit.outcome, ContactOutcome::Fitted);
  EXPECT_NEAR(fit.value, 400.0, 1e-9);  // rounding
  EXPECT_NEAR(fit.variance, 0.0, 1e-15);
  EXPECT_FALSE(fit.approach_seen);
}

TEST(FitContact, FindsContactInTheAirsEnd) {
  Random random(1);
  const ContactFit fit =
      fit_contact(pressed({.air_mm = 1.53, .zero_n = -0.2, .drift_n_per_s = 0.01}, spring, random));
  EXPECT_TRUE(fit.approach_seen);
  EXPECT_NEAR(fit.value, 400.0, 1e-4);  // the search's last step
  EXPECT_NEAR(fit.contact_depth_m, 0.010 + 1.53e-3, 1e-8);
}

TEST(FitContact, GivesHertzsModulusExactly) {
  Random random(1);
  const ContactOptions options{.model = ContactModel::Hertz, .indenter_radius_m = kRadius_m};
  for (const double air_mm : {0.0, 1.5}) {
    const ContactFit fit = fit_contact(pressed({.air_mm = air_mm}, hertz, random), options);
    EXPECT_EQ(fit.approach_seen, air_mm > 0.0);
    EXPECT_NEAR(fit.value, 8000.0, 0.5);  // the search's last step
    EXPECT_NEAR(fit.contact_depth_m, 0.010 + air_mm * 1e-3, 1e-7);
  }
}

TEST(FitContact, GivesTheForceAtADepth) {
  Random random(1);
  const auto bowl = [](double past_m) { return 100.0 * past_m + 5e4 * past_m * past_m; };
  const ContactOptions options{.model = ContactModel::ForceAtDepth, .at_depth_m = 0.002};
  const ContactFit air =
      fit_contact(pressed({.air_mm = 2.0, .zero_n = 0.3}, bowl, random), options);
  EXPECT_TRUE(air.approach_seen);
  EXPECT_NEAR(air.value, 0.4, 1e-6);
  const ContactFit touching = fit_contact(pressed({.zero_n = 0.3}, bowl, random), options);
  EXPECT_NEAR(touching.value, 0.7, 1e-9);  // with the sensor's zero, which nothing shows
}

TEST(FitContact, StatesItsErrorHonestly) {
  expect_honest(held({.noise_n = 0.02}, spring, 400.0, {}));
  expect_honest(held({.air_mm = 2.0, .zero_n = 0.3, .noise_n = 0.02}, spring, 400.0, {}));
  expect_honest(held({.air_mm = 2.0, .zero_n = 0.3, .drift_n_per_s = 0.05, .noise_n = 0.02}, spring,
                     400.0, {}));
  expect_honest(held({.deep_mm = 0.4, .noise_n = 0.003}, spring, 400.0, {}));  // five samples
  const ContactOptions sphere{.model = ContactModel::Hertz, .indenter_radius_m = kRadius_m};
  expect_honest(held({.noise_n = 0.02}, hertz, 8000.0, sphere));
  expect_honest(held({.air_mm = 2.0, .zero_n = 0.3, .drift_n_per_s = 0.01, .noise_n = 0.004}, hertz,
                     8000.0, sphere));
  const ContactOptions force{.model = ContactModel::ForceAtDepth, .at_depth_m = 0.002};
  expect_honest(held({.noise_n = 0.02}, spring, 0.8, force));
  expect_honest(held({.air_mm = 2.0, .zero_n = 0.3, .drift_n_per_s = 0.05, .noise_n = 0.02}, spring,
                     0.8, force));
}

TEST(FitContact, StatesNoVarianceFromTooFewSamples) {
  Random random(1);
  const ContactFit fit = fit_contact(pressed({.deep_mm = 0.3, .noise_n = 0.001}, spring, random));
  EXPECT_EQ(fit.outcome, ContactOutcome::Fitted);
  EXPECT_TRUE(std::isnan(fit.variance));
}

TEST(FitContact, UsesTheLoadingOnly) {
  Random random(1);
  const Indentation in = pressed({}, spring, random);
  const Eigen::Index n = in.depth_m.size();
  Indentation both{Eigen::VectorXd(2 * n), Eigen::VectorXd(2 * n)};
  both.depth_m << in.depth_m, in.depth_m.reverse();
  both.force << in.force, 0.6 * in.force.reverse();  // tissue relaxes
  EXPECT_NEAR(fit_contact(both).value, 400.0, 1e-9);
}

TEST(FitContact, ReadsAPressThatIsToldBackwards) {
  Random random(1);
  Indentation in = pressed({.air_mm = 1.5}, spring, random);
  in.depth_m.reverseInPlace();
  in.force.reverseInPlace();
  in.time_s.resize(0);
  EXPECT_NEAR(fit_contact(in).value, 400.0, 1e-4);
}

TEST(FitContact, LeavesOutSpikesHolesAndSaturation) {
  Random random(3);
  Indentation in = pressed({.noise_n = 0.01}, spring, random);
  in.force[7] = std::nan("");
  in.force[12] = 4.0;
  in.force.tail(6).setConstant(in.force[in.force.size() - 7]);
  const ContactFit fit = fit_contact(in);
  EXPECT_EQ(fit.left_out, 9);
  EXPECT_NEAR(fit.value, 400.0, 3.0 * std::sqrt(fit.variance));
}

// As a press from the air meets the sensor's limit: no line through air and tissue tells that.
TEST(FitContact, LeavesOutTheSensorsLimitFromTheAir) {
  Random random(3);
  Indentation made = pressed({.air_mm = 1.5, .deep_mm = 1.5, .noise_n = 0.002}, spring, random);
  made.force = made.force.cwiseMin(0.35);  // reached .875 mm deep
  const ContactFit fit = fit_contact(made);
  EXPECT_EQ(fit.held, 0.35);
  EXPECT_EQ(fit.left_out, 7);
  EXPECT_NEAR(fit.value, 400.0, 3.0 * std::sqrt(fit.variance));
}

// A spike at the deepest sample draws the line to itself: its residual is no larger than others'.
TEST(FitContact, LeavesOutASpikeAtAnEnd) {
  for (const double air_mm : {0.0, 1.5}) {
    for (const int from_end : {1, 2}) {
      Random random(2);
      Indentation made =
          pressed({.air_mm = air_mm, .deep_mm = 1.5, .noise_n = 0.002}, spring, random);
      made.force[made.force.size() - from_end] += 3.0;
      const ContactFit fit = fit_contact(made);
      EXPECT_EQ(fit.left_out, 1) << air_mm << from_end;
      EXPECT_NEAR(fit.value, 400.0, 3.0 * std::sqrt(fit.variance));
      EXPECT_LT(std::sqrt(fit.variance), 8.0);
    }
  }
}

// What no spike is stays: of 1,000 presses with Gaussian noise, short and long ones, from the air
// or not, a robust standard deviation and the largest step err in four at most. Ten are 3 sd above.
TEST(FitContact, LeavesNoSampleOfPlainNoiseOut) {
  for (const double air_mm : {0.0, 1.0}) {
    for (const double deep_mm : {1.0, 3.0}) {
      int left_out = 0;
      for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        Random random(seed);
        left_out += fit_contact(pressed({.air_mm = air_mm, .deep_mm = deep_mm, .noise_n = 0.01},
                                        spring, random))
                        .left_out;
      }
      EXPECT_LE(left_out, 10) << air_mm << " mm of air, " << deep_mm << " mm deep";
    }
  }
}

// A force that bends, Hertz's, is no line; but its end is no spike.
TEST(FitContact, TakesNoBendForASpike) {
  Random random(4);
  const Indentation made = pressed({.deep_mm = 3.0, .noise_n = 0.0005}, hertz, random);
  EXPECT_EQ(fit_contact(made).left_out, 0);
}

TEST(FitContact, SaysWhyThereIsNone) {
  Random random(5);
  const auto nothing = [](double) { return 0.0; };
  const Indentation air = pressed({.noise_n = 0.02}, nothing, random);
  EXPECT_EQ(fit_contact(air).outcome, ContactOutcome::NoContact);
  EXPECT_EQ(fit_contact(pressed({}, nothing, random)).outcome, ContactOutcome::Stuck);
  EXPECT_EQ(fit_contact({Eigen::Vector2d(0, 1e-3), Eigen::Vector2d(0, 1)}).outcome,
            ContactOutcome::TooFewSamples);
  EXPECT_EQ(fit_contact({Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(0, 1, 2)}).outcome,
            ContactOutcome::NotMonotone);
  Indentation shaking = pressed({}, spring, random);
  for (Eigen::Index i = 0; i < shaking.depth_m.size(); ++i)
    shaking.depth_m[i] = 1e-3 * std::sin(static_cast<double>(i));
  EXPECT_EQ(fit_contact(shaking).outcome, ContactOutcome::NotMonotone);
  const ContactOptions force{.model = ContactModel::ForceAtDepth, .at_depth_m = 0.005};
  EXPECT_EQ(fit_contact(pressed({}, spring, random), force).outcome, ContactOutcome::NotSoDeep);
}

TEST(FitContact, SeldomSeesContactInNoise) {
  const auto nothing = [](double) { return 0.0; };
  int seen = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Random random(seed);
    seen +=
        fit_contact(pressed({.noise_n = 0.02}, nothing, random)).outcome == ContactOutcome::Fitted;
  }
  EXPECT_LE(seen, 4);
}

TEST(FitContact, RefusesWhatIsNoOption) {
  const Indentation in{Eigen::Vector3d(0, 1, 2), Eigen::Vector3d(0, 1, 2)};
  EXPECT_THROW(fit_contact(in, {.model = ContactModel::Hertz}), InvalidInput);
  EXPECT_THROW(fit_contact(in, {.model = ContactModel::ForceAtDepth}), InvalidInput);
  EXPECT_THROW(fit_contact(in, {.least_samples = 1}), InvalidInput);
  EXPECT_THROW(fit_contact({Eigen::Vector3d(0, 1, 2), Eigen::Vector2d(0, 1)}), InvalidInput);
}

}  // namespace
}  // namespace palpation
