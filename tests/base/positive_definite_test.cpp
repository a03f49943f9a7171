#include "base/positive_definite.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "palpation/base/random.h"

namespace palpation {
namespace {

/// Of n points at random, as a field of length 1 has it, with noise.
Eigen::MatrixXd covariance(int size, double noise_variance, std::uint64_t seed) {
  Random random(seed);
  Eigen::MatrixXd places(size, 2);
  for (double& coordinate : places.reshaped()) coordinate = 4.0 * random.uniform();
  Eigen::MatrixXd matrix(size, size);
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j)
      matrix(i, j) = std::exp(-0.5 * (places.row(i) - places.row(j)).squaredNorm());
    matrix(i, i) += noise_variance;
  }
  return matrix;
}

TEST(PositiveDefinite, InverseAndDeterminantAreThoseOfEigen) {
  PositiveDefiniteInverse invert;  // in memory that another matrix, smaller or larger, has used
  for (const int size : {205, 1, 2, 7, 8, 9, 16, 63, 105, 205}) {
    const Eigen::MatrixXd matrix = covariance(size, 0.01, 3 + static_cast<std::uint64_t>(size));
    Eigen::MatrixXd inverse = matrix;
    const std::optional<double> log_determinant = invert(inverse);
    ASSERT_TRUE(log_determinant);
    const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
    const Eigen::MatrixXd expected = factor.solve(Eigen::MatrixXd::Identity(size, size));
    const Eigen::MatrixXd both_halves = inverse.selfadjointView<Eigen::Lower>();
    EXPECT_LE((both_halves - expected).cwiseAbs().maxCoeff(),
              1e-10 * expected.cwiseAbs().maxCoeff())
        << size;
    for (int i = 0; i < size; ++i)
      EXPECT_EQ(inverse.col(i).head(i), matrix.col(i).head(i)) << "above the diagonal";
    EXPECT_NEAR(*log_determinant, 2.0 * factor.matrixLLT().diagonal().array().log().sum(),
                1e-11 * size)
        << size;
  }
}

TEST(PositiveDefinite, LeavesAlmostNothingOfTheIdentity) {
  const Eigen::MatrixXd matrix = covariance(205, 1e-4, 9);
  Eigen::MatrixXd inverse = matrix;
  ASSERT_TRUE(PositiveDefiniteInverse()(inverse));
  inverse = Eigen::MatrixXd(inverse.selfadjointView<Eigen::Lower>());
  const double condition = matrix.norm() * inverse.norm();
  EXPECT_LE((matrix * inverse - Eigen::MatrixXd::Identity(205, 205)).cwiseAbs().maxCoeff(),
            1e-15 * condition);
}

TEST(PositiveDefinite, SaysWhatIsNot) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(10, 10);
  matrix(9, 9) = -1.0;
  const Eigen::MatrixXd before = matrix;
  EXPECT_FALSE(PositiveDefiniteInverse()(matrix));
  EXPECT_EQ(matrix, before);
  matrix(9, 9) = std::nan("");
  EXPECT_FALSE(PositiveDefiniteInverse()(matrix));
  Eigen::MatrixXd singular = Eigen::MatrixXd::Ones(3, 3);
  EXPECT_FALSE(PositiveDefiniteInverse()(singular));
}

}  // namespace
}  // namespace palpation
