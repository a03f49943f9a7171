#include "palpation/belief/hyperparameters.h"

#include <gtest/gtest.h>

#include <cmath>

#include "belief/likelihood.h"
#include "belief/noise_alone.h"
#include "belief/sites.h"
#include "belief/tissue.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// One place touched twice, and one reading whose noise is known.
std::vector<Palpation> odd_readings(const Surface& tissue, Random& random) {
  std::vector<Palpation> readings = bumpy_readings(tissue, 40, random);
  readings.push_back(readings[5]);
  readings[7].noise_variance = 0.3;
  return readings;
}

TEST(Likelihood, IsTheBeliefsOwn) {
  const Surface tissue = plane(20, 40);
  Random random(1);
  std::vector<Palpation> readings = bumpy_readings(tissue, 40, random);
  readings.push_back(readings[5]);  // a repeated touch
  readings.back().reading += 0.1;
  readings[7].noise_variance = 0.3;
  for (const double constant_sd : {0.0, 4.0, kUnknown}) {
    const Prior prior(tissue, Metric::Chart, {.length_m = 0.004, .signal_sd = 1.3},
                      {.sd = constant_sd});
    const double ours =
        likelihood_gradient(prior, gather_sites(prior, readings), {0.004, 1.3, 0.2}).value;
    const double beliefs =
        Belief(prior, {.noise_sd = 0.2}).condition_on(readings).log_marginal_likelihood();
    EXPECT_NEAR(ours, beliefs, 1e-8);
  }
}

TEST(Likelihood, HasTheGradientOfItsDifferences) {
  const Surface tissue = plane(20, 40);
  Random random(2);
  std::vector<Palpation> readings = bumpy_readings(tissue, 25, random);
  for (int i = 0; i < 3; ++i) {
    readings.push_back(readings[5]);
    readings.back().reading += 0.1 * i;
    readings.back().noise_variance =
        i == 2 ? 0.02 : std::nan("");  // a place with both kinds of noise
  }
  for (const KernelFamily family : {KernelFamily::SquaredExponential, KernelFamily::Matern12,
                                    KernelFamily::Matern32, KernelFamily::Matern52}) {
    for (const double constant_sd : {0.0, 4.0, kUnknown}) {
      const Prior prior(tissue, Metric::Chart, {.family = family}, {.sd = constant_sd});
      const std::vector<Site> sites = gather_sites(prior, readings);
      const Hyperparameters at{0.0045, 0.9, 0.15};
      const auto moved = [&](int parameter, double by) {
        Hyperparameters there = at;
        if (parameter == 0) there.length_m *= std::exp(by);
        if (parameter == 1) there.signal_sd *= std::exp(by);
        if (parameter == 2) there.noise_sd *= std::exp(by);
        return likelihood_gradient(prior, sites, there).value;
      };
      const Vec3 gradient = likelihood_gradient(prior, sites, at).gradient;
      for (int parameter = 0; parameter < 3; ++parameter) {
        // Central differences at step 1e-4: truncation 1e-8 x third derivative, rounding 1e-12 /
        // 1e-4.
        EXPECT_NEAR(gradient[parameter], (moved(parameter, 1e-4) - moved(parameter, -1e-4)) / 2e-4,
                    2e-5)
            << parameter;
      }
    }
  }
}

Slope some_slope() { return {.sd = {40.0, 25.0, 0.0}, .origin = {0.0125, 0.025, 0.0}}; }

TEST(Likelihood, IsTheBeliefsOwnWithASlopeToo) {
  const Surface tissue = plane(20, 40);
  Random random(1);
  const std::vector<Palpation> readings = odd_readings(tissue, random);
  for (const double constant_sd : {0.0, 4.0, kUnknown}) {
    const Prior prior(tissue, Metric::Chart, {.length_m = 0.004, .signal_sd = 1.3},
                      {.sd = constant_sd}, some_slope());
    const double ours =
        likelihood_gradient(prior, gather_sites(prior, readings), {0.004, 1.3, 0.2}).value;
    EXPECT_NEAR(ours,
                Belief(prior, {.noise_sd = 0.2}).condition_on(readings).log_marginal_likelihood(),
                1e-8);
  }
}

TEST(Likelihood, HasTheGradientOfItsDifferencesWithASlopeToo) {
  const Surface tissue = plane(20, 40);
  Random random(2);
  const std::vector<Palpation> readings = bumpy_readings(tissue, 25, random);
  for (const double constant_sd : {0.0, 4.0, kUnknown}) {
    const Prior prior(tissue, Metric::Chart, {}, {.sd = constant_sd}, some_slope());
    const std::vector<Site> sites = gather_sites(prior, readings);
    const auto value = [&](const Vec3& logs) {
      return likelihood_gradient(prior, sites,
                                 {std::exp(logs[0]), std::exp(logs[1]), std::exp(logs[2])});
    };
    const Vec3 at(std::log(0.0045), std::log(0.9), std::log(0.15));
    const Vec3 gradient = value(at).gradient;
    for (int parameter = 0; parameter < 3; ++parameter) {
      const Vec3 step =
          1e-4 *
          Vec3::Unit(parameter);  // truncation 1e-8 x third derivative, rounding 1e-12 / 1e-4
      EXPECT_NEAR(gradient[parameter], (value(at + step).value - value(at - step).value) / 2e-4,
                  2e-5)
          << parameter;
    }
  }
}

TEST(Likelihood, IsTheSameWithoutItsGradient) {
  const Surface tissue = plane(20, 40);
  Random random(5);
  const std::vector<Palpation> readings = odd_readings(tissue, random);
  for (const double constant_sd : {0.0, 4.0, kUnknown}) {
    for (const Slope& slope : {Slope{}, some_slope()}) {
      const Prior prior(tissue, Metric::Chart, {.family = KernelFamily::Matern52},
                        {.sd = constant_sd}, slope);
      const std::vector<Site> sites = gather_sites(prior, readings);
      const Hyperparameters at{0.004, 1.3, 0.2};
      EXPECT_NEAR(log_likelihood(prior, sites, at), likelihood_gradient(prior, sites, at).value,
                  1e-8);
    }
  }
}

TEST(Learn, SeesNoSignalInATiltedPlane) {
  const Surface tissue = plane(20, 40);
  Random random(4);
  std::vector<Palpation> readings = bumpy_readings(tissue, 30, random);
  for (Palpation& palpation : readings)
    palpation.reading = 7.0 + 60.0 * tissue.position(palpation.where).y() + 0.05 * random.normal();
  const Slope slope = slope_across(tissue, Metric::Chart, 2.0);
  EXPECT_LT(learn(Prior(tissue, Metric::Chart, {}, {}, slope), readings, {}, {}).signal_evidence,
            0.0);
  EXPECT_GT(learn(Prior(tissue, Metric::Chart, {}), readings, {}, {}).signal_evidence, 30.0);
}

TEST(Learn, GainsNothingOverTheBest) {
  const Surface tissue = plane(26, 51);
  Random random(5);
  const std::vector<Palpation> readings = bumpy_readings(tissue, 60, random);
  const Prior prior(tissue, Metric::Chart, {});
  const Learned best = learn(prior, readings, {}, {});
  EXPECT_LT(learn(prior, readings, best.values, {}).gain, 1e-6);
  Hyperparameters worse = best.values;
  worse.length_m *= 1.5;
  EXPECT_GT(learn(prior, readings, worse, {}).gain, 0.1);
  worse.length_m = 1.0;  // no length that is looked for
  EXPECT_EQ(learn(prior, readings, worse, {}).gain, std::numeric_limits<double>::infinity());
}

TEST(Learn, FindsAnOptimum) {
  const Surface tissue = plane(40, 80);
  Random random(3);
  const std::vector<Palpation> readings = bumpy_readings(tissue, 100, random);
  const Prior prior(tissue, Metric::Chart, {});
  const Learned learned = learn(prior, readings, {}, {});
  const auto posterior = [&](const Hyperparameters& at) {
    const double l = std::log(at.length_m / 0.0035) / 0.4;
    const double r = (2.0 * std::log(at.noise_sd / at.signal_sd) - std::log(0.02)) / 2.0;
    return likelihood_gradient(prior, gather_sites(prior, readings), at).value -
           0.5 * (l * l + r * r);
  };
  EXPECT_NEAR(posterior(learned.values), learned.log_posterior, 1e-8);
  for (const double factor : {0.97, 1.03}) {
    Hyperparameters near = learned.values;
    near.length_m *= factor;
    EXPECT_LT(posterior(near), learned.log_posterior);
    near = learned.values;
    near.noise_sd *= factor;
    EXPECT_LT(posterior(near), learned.log_posterior);
  }
  EXPECT_GT(learned.signal_evidence, 20.0);
  // The bump is 2 high with a noise of 0.05.
  EXPECT_NEAR(learned.values.noise_sd, 0.05, 0.03);
}

TEST(Learn, KeepsWhatIsFixed) {
  const Surface tissue = plane(40, 80);
  Random random(4);
  const std::vector<Palpation> readings = bumpy_readings(tissue, 50, random);
  const Learned learned =
      learn(Prior(tissue, Metric::Chart, {}), readings, {}, {.length_m = 0.004, .noise_sd = 0.05});
  EXPECT_EQ(learned.values.length_m, 0.004);
  EXPECT_EQ(learned.values.noise_sd, 0.05);
  EXPECT_GT(learned.values.signal_sd, 0.3);
}

TEST(Learn, SeesNoFieldInNoise) {
  const Surface tissue = plane(40, 80);
  Random random(5);
  std::vector<Palpation> readings = bumpy_readings(tissue, 40, random);
  for (Palpation& palpation : readings) palpation.reading = 7.0 + 0.3 * random.normal();
  EXPECT_LT(learn(Prior(tissue, Metric::Chart, {}), readings, {}, {}).signal_evidence, 3.0);
}

// The scatter of readings at one place is as probable by noise alone as by noise beside a field,
// whatever the unit.
TEST(Learn, SeesNoFieldInNoiseThatWasFeltAgain) {
  const Surface tissue = plane(40, 80);
  for (const bool slopes : {false, true}) {
    const Prior prior(tissue, Metric::Chart, {}, {}, slopes ? some_slope() : Slope{});
    for (const double unit : {1.0, 1e-3, 1e3}) {
      Random random(5);
      std::vector<Palpation> readings = bumpy_readings(tissue, 40, random);
      for (int again = 0; again < 2; ++again)
        readings.insert(readings.end(), readings.begin(), readings.begin() + 40);
      for (Palpation& palpation : readings)
        palpation.reading = unit * (7.0 + 0.3 * random.normal());
      EXPECT_LT(learn(prior, readings, {}, {}).signal_evidence, 3.0) << slopes << " " << unit;
      readings = bumpy_readings(tissue, 40, random);
      readings.insert(readings.end(), readings.begin(), readings.begin() + 40);
      for (Palpation& palpation : readings)
        palpation.reading = unit * (palpation.reading + 0.05 * random.normal());
      EXPECT_GT(learn(prior, readings, {}, {}).signal_evidence, 20.0) << slopes << " " << unit;
    }
  }
}

// One site that was felt thrice is as three that lie in one place.
TEST(NoiseAlone, CountsEachReadingOfASite) {
  const Surface tissue = plane(20, 40);
  Random random(6);
  const std::vector<Palpation> readings = bumpy_readings(tissue, 12, random);
  for (const Slope& slope : {Slope{}, some_slope()}) {
    const Prior prior(tissue, Metric::Chart, {}, {}, slope);
    std::vector<Site> one_by_one = gather_sites(prior, readings), together;
    std::vector<double> values, means;
    for (std::size_t i = 0; i < one_by_one.size(); ++i) {
      values.push_back(readings[i].reading);
      if (i % 3 == 0) {
        together.push_back(one_by_one[i]);
        means.push_back((readings[i].reading + readings[i + 1].reading + readings[i + 2].reading) /
                        3.0);
        continue;
      }
      one_by_one[i].place = together.back().place;
      together.back().plain.push_back(readings[i].reading);
    }
    EXPECT_NEAR(noise_alone(prior, together, means).log_likelihood,
                noise_alone(prior, one_by_one, values).log_likelihood, 1e-9);
  }
}

TEST(Learn, SurvivesReadingsThatAreAllTheSame) {
  const Surface tissue = plane(20, 40);
  Random random(6);
  std::vector<Palpation> readings = bumpy_readings(tissue, 20, random);
  for (Palpation& palpation : readings) palpation.reading = 7.0;
  const Learned learned = learn(Prior(tissue, Metric::Chart, {}), readings, {}, {});
  EXPECT_TRUE(std::isfinite(learned.values.length_m));
  EXPECT_GT(learned.values.signal_sd, 0.0);
}

TEST(Learn, NeedsTwoPlaces) {
  const Surface tissue = plane(20, 40);
  const std::vector<Palpation> one{touch(tissue, 3, 7.0), touch(tissue, 3, 7.1)};
  EXPECT_THROW(learn(Prior(tissue, Metric::Chart, {}), one, {}, {}), InvalidInput);
}

TEST(Learn, TakesReadingsThatLieOnAPlaneToTheirLastDigit) {
  const Surface tissue = plane(41, 41);
  std::vector<Palpation> rising;
  for (int i = 0; i < 16; ++i)
    rising.push_back(touch(tissue, 41 * (i / 4) + i % 4, 7.0 + 0.01 * (i % 4)));
  const Prior level(tissue, Metric::Chart, {});
  const Learned learned =
      learn(level.with(level.kernel(), {}, Slope{.sd = {1.0, 1.0, 0.0}}), rising, {}, {});
  const double rounding_sd = 0.01 / std::sqrt(12.0);
  EXPECT_GE(learned.values.noise_sd, 0.999 * rounding_sd);
  EXPECT_TRUE(std::isfinite(learned.values.signal_sd));
}

TEST(Learn, TakesNoNoiseForLessThanTheStepOfTheReadings) {
  const Surface tissue = plane(41, 41);
  std::vector<Palpation> alike;
  for (int i = 0; i < 40; ++i)
    alike.push_back(touch(tissue, 41 * i + 5, i < 20 ? 7.0 : i < 38 ? 7.5 : 8.0));
  const Learned learned = learn(Prior(tissue, Metric::Chart, {.length_m = 0.0035}), alike, {}, {});
  EXPECT_GE(learned.values.noise_sd, 0.999 * 0.5 / std::sqrt(12.0));
}

}  // namespace
}  // namespace palpation
