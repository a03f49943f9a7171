// Probabilities far out, where one half plus an error function has no digits left.
#include <gtest/gtest.h>

#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "base/normal.h"
#include "palpation/certainty/certainty.h"
#include "palpation/certainty/expected_error.h"

namespace palpation {
namespace {

using Big = boost::multiprecision::cpp_bin_float_50;

Marginals sure_by(double z) {
  return {Eigen::VectorXd::Constant(1, 8.0 + z), Eigen::VectorXd::Constant(1, 1.0)};
}

TEST(Tails, ProbabilityKeepsTwelveDigitsAsLongAsThereIsANumberForIt) {
  for (double z = -1.0; z > -37.0; z -= 0.5) {
    const double ours = probability_inside(sure_by(z), {8.0, std::nullopt})[0];
    const Big exact = boost::math::erfc(Big(-z) / sqrt(Big(2))) / 2;
    EXPECT_LT(static_cast<double>(abs(Big(ours) / exact - 1)), 1e-12) << z;
    EXPECT_EQ(probability_inside(sure_by(-z), {8.0, std::nullopt})[0], 1.0 - ours);
  }
  for (const double z : {-40.0, -1e3, -1e8, -1e154})
    EXPECT_EQ(probability_inside(sure_by(z), {8.0, std::nullopt})[0], 0.0) << z;
}

TEST(Tails, ACutRiskIsTheScoreThatHasIt) {
  for (const double risk : {1e-300, 1e-100, 1e-15, 1e-6, 0.05, 0.5}) {
    const double score = Certainty::cut_score(risk);
    const Big exact = boost::math::erfc(Big(-score) / sqrt(Big(2))) / 2;
    // A score is known to its last digit, and the risk's logarithm is as steep as the score.
    EXPECT_LT(static_cast<double>(abs(Big(exact) / Big(risk) - 1)), 4e-16 * (1.0 + score * score))
        << risk;
  }
}

TEST(Tails, WhatMayBeMisjudgedIsNeverLessThanNothing) {
  for (double z = 0.0; z < 60.0; z += 0.25) {
    double before = owens_t(z, INFINITY);
    EXPECT_NEAR(before, 0.25 * std::erfc(z / std::sqrt(2.0)), 1e-12);
    for (const double known : {1e-12, 1e-6, 0.1, 0.9, 1.0 - 1e-9}) {  // of the variance
      const double after = owens_t(z, std::sqrt((1.0 - known) / known));
      EXPECT_LE(after, before + 1e-12) << z << " " << known;
      EXPECT_GE(after, 0.0) << z << " " << known;
    }
  }
}

}  // namespace
}  // namespace palpation
