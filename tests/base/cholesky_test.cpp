#include "base/cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "palpation/base/random.h"

namespace palpation {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

RowMajor random_square(int size) {
  Random random(static_cast<std::uint64_t>(size));
  RowMajor root(size, size);
  for (double& value : root.reshaped()) value = random.normal();
  return root * root.transpose() + 0.1 * RowMajor::Identity(size, size);
}

TEST(Factorize, LeavesLAndNothingElseOfWhatLiesBetweenItsRows) {
  for (const int size : {1, 2, 7, 8, 9, 16, 61, 300}) {
    const RowMajor matrix = random_square(size);
    RowMajor rows = RowMajor::Constant(size, size + 5, 7.0);
    rows.leftCols(size).triangularView<Eigen::Lower>() = matrix;
    ASSERT_EQ(factorize(rows.data(), rows.cols(), size), size);
    const RowMajor lower = rows.leftCols(size).triangularView<Eigen::Lower>();
    // Backward stable: n eps of the matrix.
    EXPECT_LE((lower * lower.transpose() - matrix).cwiseAbs().maxCoeff(),
              1e-16 * size * matrix.diagonal().maxCoeff() + 1e-15)
        << size;
    EXPECT_TRUE((rows.rightCols(5).array() == 7.0).all()) << size;
    for (int row = 0; row < size; ++row)
      EXPECT_TRUE((rows.row(row).segment(row + 1, size - row - 1).array() == 7.0).all());
  }
}

TEST(Factorize, NamesTheFirstRowWithoutAPivotAndLeavesItThere) {
  for (const int wrong : {0, 3, 8, 20}) {
    RowMajor matrix = random_square(21);
    const Eigen::VectorXd along = matrix.row(wrong).head(wrong);
    const double explained =
        wrong == 0 ? 0.0 : along.dot(matrix.topLeftCorner(wrong, wrong).llt().solve(along));
    matrix(wrong, wrong) = explained - 0.25;
    ASSERT_EQ(factorize(matrix.data(), matrix.cols(), 21), wrong);
    EXPECT_NEAR(matrix(wrong, wrong), -0.25, 1e-10);
  }
  RowMajor matrix = random_square(10);
  matrix(9, 4) = std::nan("");
  EXPECT_EQ(factorize(matrix.data(), matrix.cols(), 10), 9);
}

TEST(TiledLlt, AgreesWithEigens) {
  for (const int size : {1, 7, 8, 61, 200}) {
    const Eigen::MatrixXd matrix = random_square(size);
    const TiledLlt tiled(matrix);
    const Eigen::LLT<Eigen::MatrixXd> eigens(matrix);
    ASSERT_EQ(tiled.info(), Eigen::Success);
    const Eigen::VectorXd right = matrix.rowwise().sum();
    EXPECT_LT((tiled.solve(right) - Eigen::VectorXd::Ones(size)).norm(), 1e-9 * size);
    EXPECT_LT((tiled.reconstructedMatrix() - matrix).norm(), 1e-14 * matrix.norm());
    const Eigen::MatrixXd inverse = eigens.solve(Eigen::MatrixXd::Identity(size, size));
    EXPECT_LT((tiled.inverse_diagonal() - inverse.diagonal()).norm(), 1e-10 * inverse.norm());
  }
}

TEST(TiledLlt, SaysWhereAMatrixIsNotPositiveDefinite) {
  Eigen::MatrixXd matrix = random_square(20);
  matrix(13, 13) = -1.0;
  EXPECT_EQ(TiledLlt(matrix).info(), Eigen::NumericalIssue);
}

}  // namespace
}  // namespace palpation
