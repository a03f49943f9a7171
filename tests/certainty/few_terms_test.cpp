#include "certainty/few_terms.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

namespace palpation {
namespace {

/// Of errors that last over thirty of two hundred readings, the higher the later.
Eigen::MatrixXd fading() {
  const Eigen::VectorXd height = Eigen::VectorXd::LinSpaced(200, 1.0, 1.4);
  Eigen::MatrixXd covariance = height * height.transpose();
  for (Eigen::Index a = 0; a < 200; ++a) {
    for (Eigen::Index b = 0; b < 200; ++b)
      covariance(a, b) *= std::exp(-std::abs(static_cast<double>(a - b)) / 30.0);
  }
  return covariance;
}

double least_eigenvalue(const Eigen::MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues().minCoeff();
}

TEST(FewTerms, LeaveOutATwentiethOfTheVarianceAtMost) {
  const Eigen::MatrixXd covariance = fading();
  const FewTerms few = few_terms(covariance);
  EXPECT_TRUE(few.is_whole);
  EXPECT_LT(few.terms.cols(), 120);
  const Eigen::MatrixXd left = covariance - few.terms * few.terms.transpose();
  EXPECT_LE(left.diagonal().maxCoeff(), 0.05 * covariance.diagonal().maxCoeff());
  EXPECT_GE(least_eigenvalue(left), -1e-10);
}

TEST(FewTerms, KnowTheirPivotsWhollyAndBeginAtTheFirst) {
  const Eigen::MatrixXd covariance = fading();
  const FewTerms few = few_terms(covariance, {.first_pivot = 42});
  ASSERT_FALSE(few.pivots.empty());
  EXPECT_EQ(few.pivots.front(), 42);
  const Eigen::MatrixXd known = few.terms * few.terms.transpose();
  for (const Eigen::Index pivot : few.pivots)
    EXPECT_LT((known.col(pivot) - covariance.col(pivot)).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(FewTerms, AreNotWholeWhereTheyMayNotBeAsMany) {
  const FewTerms few = few_terms(fading(), {.most = 5});
  EXPECT_FALSE(few.is_whole);
  EXPECT_EQ(few.terms.cols(), 5);
}

TEST(FewTerms, AreNoneOfNothing) {
  EXPECT_EQ(few_terms(Eigen::MatrixXd()).terms.cols(), 0);
  EXPECT_EQ(few_terms(Eigen::MatrixXd(Eigen::MatrixXd::Zero(3, 3))).terms.cols(), 0);
}

}  // namespace
}  // namespace palpation
