#include "probing/demodulation.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <complex>

#include "palpation/base/random.h"

namespace palpation {
namespace {

// White noise of .05 over four periods of 2 Hz, 67 samples a second: an amplitude by least squares
// errs by .05^2 times two entries of (B'B)^-1. The neighbours hold the same noise, of which the
// cubic in time has taken a part, most of it from the lowest.
TEST(Beside, TellsWhiteNoiseFromWhatTheBasisLeavesOfIt) {
  constexpr double kNoise = 0.05, kFrequency_hz = 2.0, kHalf_s = 1.0;
  constexpr int kPeriods = 4, kSamples = 134, kDraws = 4000;
  const Eigen::VectorXd time_s = Eigen::VectorXd::LinSpaced(kSamples, -kHalf_s, kHalf_s);
  const Eigen::MatrixXd basis = basis_of(time_s, kFrequency_hz, kHalf_s);
  const Eigen::MatrixXd covariance = (basis.transpose() * basis).inverse();
  const double expected =
      kNoise * kNoise * (covariance(kDrift, kDrift) + covariance(kDrift + 1, kDrift + 1));

  const Eigen::HouseholderQR<Eigen::MatrixXd> solver(basis);
  const Beside beside(time_s, solver, basis, kFrequency_hz, kPeriods);
  Random random(1);
  double sum = 0.0, own = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::VectorXd noise(kSamples);
    for (double& value : noise) value = kNoise * random.normal();
    const Demodulated parts = demodulate(solver, basis, noise);
    sum += beside.error(parts.left.col(0), Eigen::VectorXd::Zero(kSamples), 0.0);
    own += std::norm(parts.amplitudes(0, 0));
  }
  // Means of so many squares: 1.6 % and, of four neighbours each, .8 %.
  EXPECT_NEAR(own / kDraws / expected, 1.0, 0.05);
  EXPECT_NEAR(sum / kDraws / expected, 1.0, 0.03);
}

}  // namespace
}  // namespace palpation
