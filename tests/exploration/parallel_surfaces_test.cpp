#include "exploration/parallel_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpation/base/random.h"

namespace palpation {
namespace {

constexpr double kNoise = 0.02;

struct World {
  SharedBackground background;
  Eigen::VectorXd values;
};

/// Four in ten values are 0.4 higher, on a background of two terms.
World world(const Eigen::Vector2d& coefficients, double precision) {
  constexpr int kCount = 100;
  Random random(1);
  World made{{Eigen::MatrixXd(kCount, 2), Eigen::Vector2d::Constant(precision)},
             Eigen::VectorXd(kCount)};
  for (int i = 0; i < kCount; ++i) {
    const double at = i / (kCount - 1.0);
    made.background.terms.row(i) << at, std::sin(6.0 * at);
    const double stiff = i % 10 < 4 ? 0.4 : 0.0;
    made.values[i] =
        0.1 + stiff + made.background.terms.row(i).dot(coefficients) + kNoise * random.normal();
  }
  return made;
}

TEST(ParallelSurfaces, AreFoundFromALevelStart) {
  const Eigen::Vector2d truth(0.3, -0.1);
  for (const double precision : {0.0, 1.0}) {
    const auto [background, values] = world(truth, precision);
    const ParallelSurfaces found =
        parallel_surfaces(background, values, Eigen::VectorXd::Zero(values.size()));
    EXPECT_LT((found.coefficients - truth).norm(), 0.03) << precision;
    EXPECT_NEAR(found.low, 0.1, 0.02);
    EXPECT_NEAR(found.contrast, 0.4, 0.02);
    EXPECT_NEAR(found.high_share, 0.4, 0.02);
    EXPECT_NEAR(std::sqrt(found.variance), kNoise, 0.005);
  }
}

TEST(ParallelSurfaces, EvidenceIsTheIntegralOverBackgrounds) {
  const auto [background, values] = world({0.3, -0.1}, 4.0);
  const ParallelSurfaces found =
      parallel_surfaces(background, values, Eigen::VectorXd::Zero(values.size()));
  const double height = 0.9 / std::sqrt(2.0 * 3.14159265358979 * found.variance);
  const auto log_likelihood = [&](const Eigen::Vector2d& coefficients) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      const double off = values[i] - found.low - background.terms.row(i).dot(coefficients);
      const auto near = [&](double z) { return std::exp(-0.5 * z * z / found.variance); };
      sum += std::log(height * ((1.0 - found.high_share) * near(off) +
                                found.high_share * near(off - found.contrast)) +
                      0.1);
    }
    return sum;
  };
  // The posterior is a hundredth wide.
  constexpr double kStep = 0.001;
  double integral = 0.0;
  for (int a = -60; a <= 60; ++a) {
    for (int b = -60; b <= 60; ++b) {
      const Eigen::Vector2d at = found.coefficients + kStep * Eigen::Vector2d(a, b);
      integral += kStep * kStep * 4.0 / (2.0 * 3.14159265358979) *
                  std::exp(log_likelihood(at) - found.log_likelihood - 2.0 * at.squaredNorm());
    }
  }
  // Laplace takes the surface that each value lies on for known.
  EXPECT_NEAR(found.log_evidence, found.log_likelihood + std::log(integral), 0.2);
}

}  // namespace
}  // namespace palpation
