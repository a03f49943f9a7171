// Kernels where their arguments are next to nothing or beyond all measure, against eighty digits.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "belief/oracle.h"
#include "belief/tissue.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr KernelFamily kFamilies[] = {KernelFamily::SquaredExponential, KernelFamily::Matern12,
                                      KernelFamily::Matern32, KernelFamily::Matern52,
                                      KernelFamily::Periodic};

Kernel kernel_of(KernelFamily family, double length_m = 0.0033) {
  return {.family = family, .length_m = length_m, .period_m = 0.05};
}

TEST(KernelExtremes, WhatIsMissingToOneKeepsFourteenDigitsHoweverLittleItIs) {
  for (const KernelFamily family : kFamilies) {
    const Kernel kernel = kernel_of(family);
    for (double r = 1e-150; r < 30.0; r *= r < 1e-10 ? 1e10 : 1.7) {
      const Vec3 difference = Vec3(0.48, -0.6, 0.64) * r * kernel.length_m;
      const Big exact = 1 - big_correlation(kernel, difference, Vec3::Zero());
      if (static_cast<double>(exact) < 1e-60)
        continue;  // of eighty digits too few are left, or the square underflows
      EXPECT_LT(relative_error(decorrelation(kernel, difference), exact), 1e-14)
          << r << " lengths, kernel " << static_cast<int>(family);
    }
    EXPECT_EQ(decorrelation(kernel, Vec3::Zero()), 0.0);
  }
}

TEST(KernelExtremes, ASmallStepChangesACorrelationToThirteenDigits) {
  for (const KernelFamily family : kFamilies) {
    const Kernel kernel = kernel_of(family);
    const Vec3 from(0.0021, 0.0007, -0.0003);
    for (double step = 1e-12; step < 1.0; step *= 10.0) {
      const Vec3 along = Vec3(0.6, 0.8, 0.0) * step * kernel.length_m;
      // In exact arithmetic the place after the step is the sum, which doubles cannot hold.
      const Big exact = [&] {
        const Big before = big_correlation(kernel, from, Vec3::Zero());
        Big r2 = 0, p2 = 0;
        const Big pi = boost::math::constants::pi<Big>();
        for (int axis = 0; axis < 3; ++axis) {
          Big d = Big(from[axis]) + Big(along[axis]);
          const Big chord = Big(kernel.period_m) / pi * sin(pi * d / Big(kernel.period_m));
          p2 += chord * chord / (Big(kernel.length_m) * Big(kernel.length_m));
          r2 += d * d / (Big(kernel.length_m) * Big(kernel.length_m));
        }
        const Big r = sqrt(r2), s3 = sqrt(Big(3)) * r, s5 = sqrt(Big(5)) * r;
        switch (family) {
          case KernelFamily::SquaredExponential:
            return Big(exp(-r2 / 2) - before);
          case KernelFamily::Periodic:
            return Big(exp(-p2 / 2) - before);
          case KernelFamily::Matern12:
            return Big(exp(-r) - before);
          case KernelFamily::Matern32:
            return Big((1 + s3) * exp(-s3) - before);
          case KernelFamily::Matern52:
            return Big((1 + s5 + s5 * s5 / 3) * exp(-s5) - before);
        }
        return before;
      }();
      EXPECT_LT(relative_error(correlation_change(kernel, from, along), exact), 1e-13)
          << step << ", kernel " << static_cast<int>(family);
    }
  }
}

TEST(KernelExtremes, NoLengthIsTooShortForACorrelationOfOneWithItselfAndNoneWithOthers) {
  for (const KernelFamily family : kFamilies) {
    for (const double length_m : {1e-200, 1e-300, 5e-324}) {
      EXPECT_EQ(correlation(kernel_of(family, length_m), Vec3::Zero()), 1.0);
      EXPECT_EQ(correlation(kernel_of(family, length_m), Vec3(0.001, 0.0, 0.0)), 0.0);
      EXPECT_EQ(decorrelation(kernel_of(family, length_m), Vec3(0.001, 0.0, 0.0)), 1.0);
      EXPECT_EQ(correlation_slope(kernel_of(family, length_m), Vec3(0.001, 0.0, 0.0)), 0.0);
    }
  }
}

TEST(KernelExtremes, WithALengthOfNothingEveryVertexKnowsItselfAlone) {
  const Surface tissue = plane(10, 20);
  for (const KernelFamily family : kFamilies) {
    const Prior prior(tissue, Metric::Chart, kernel_of(family, 1e-200), {.sd = 0.0});
    const std::vector<Palpation> readings{touch(tissue, 30, 4.0), touch(tissue, 31, 8.0)};
    const Marginals at = Belief(prior, {.noise_sd = 1.0}).condition_on(readings).at_vertices();
    EXPECT_NEAR(at.mean[30], 2.0, 1e-15);
    EXPECT_NEAR(at.variance[31], 0.5, 1e-15);
    EXPECT_EQ(at.mean[32], 0.0);
    EXPECT_EQ(at.variance[32], 1.0);
  }
}

TEST(KernelExtremes, PlacesFarFromTheOriginDifferByTheirDifference) {
  const Vec3 here(1e6, 1e6, 0.0), there = here + Vec3(1e-3, 0.0, 0.0);
  const double gap = there.x() - here.x();  // 1e-3 to the digits that 1e6 leaves
  for (const KernelFamily family : kFamilies)
    EXPECT_EQ(correlation(kernel_of(family, 1e-3), there - here),
              correlation(kernel_of(family, 1e-3), Vec3(gap, 0.0, 0.0)));
  EXPECT_LT(correlation(kernel_of(KernelFamily::SquaredExponential, 1e-3), there - here), 0.61);

  Random unused(0);
  const Surface far(make_plane(
      {.size_m = Vec2(0.01, 0.01), .columns = 11, .rows = 11, .corner_m = Vec2(1e6, 1e6)}, unused));
  const Prior prior(far, Metric::Ambient, {.length_m = 0.003}, {.sd = 0.0});
  const std::vector<Palpation> readings{touch(far, 40, 1.0), touch(far, 41, 1.5),
                                        touch(far, 80, -1.0)};
  const Marginals at = Belief(prior, {.noise_sd = 0.1}).condition_on(readings).at_vertices();
  const BigPosterior exact(prior, readings, 0.1 * 0.1);
  for (int vertex = 0; vertex < far.vertex_count(); ++vertex) {
    EXPECT_LT(absolute_error(at.mean[vertex], exact.at(far.vertex(vertex)).mean), 1e-13);
    EXPECT_LT(absolute_error(at.variance[vertex], exact.at(far.vertex(vertex)).variance), 1e-13);
  }
}

TEST(KernelExtremes, LengthsFarBeyondTheTissueGiveFiniteAnswersAboveTheProvedFloor) {
  const Surface tissue = plane(20, 40);  // 0.05 m long
  Random random(3);
  const std::vector<Palpation> readings = bumpy_readings(tissue, 100, random);
  for (const double length_m : {0.5, 5.0, 500.0, 5e4}) {
    const Prior prior(tissue, Metric::Chart, {.length_m = length_m}, {.sd = 0.0});
    for (const double s2 : {1e-2, 1e-8, 1e-13}) {
      const Marginals at =
          Belief(prior, {.noise_sd = std::sqrt(s2)}).condition_on(readings).at_vertices();
      EXPECT_TRUE(at.mean.allFinite());
      // |k|^2 is at most the number of readings.
      EXPECT_GE(at.variance.minCoeff(), s2 / (s2 + 100.0) * (1.0 - 1e-12)) << length_m << " " << s2;
      EXPECT_LE(at.variance.maxCoeff(), 1.0);
    }
  }
}

TEST(KernelExtremes, RefusesASignalWhoseSquareIsNoNumber) {
  EXPECT_THROW(check(Kernel{.signal_sd = 1e-151}), InvalidInput);
  EXPECT_THROW(check(Kernel{.signal_sd = 1e151}), InvalidInput);
  EXPECT_NO_THROW(check(Kernel{.signal_sd = 1e150}));
}

}  // namespace
}  // namespace palpation
