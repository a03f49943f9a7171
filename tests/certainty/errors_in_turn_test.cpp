#include "certainty/errors_in_turn.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstddef>

namespace palpation {
namespace {

std::vector<std::vector<Made>> made_in_turn(std::size_t count) {
  std::vector<std::vector<Made>> made;
  for (std::size_t number = 0; number < count; ++number) made.push_back({{.number = number}});
  return made;
}

TEST(ErrorsInTurn, FadeWithEveryReadingThatIsMade) {
  const Eigen::MatrixXd errors = errors_in_turn(made_in_turn(40), 10.0);
  EXPECT_EQ(errors.diagonal(), Eigen::VectorXd::Ones(40));
  EXPECT_NEAR(errors(0, 10), std::exp(-1.0), 1e-15);
  EXPECT_EQ(errors(17, 12), errors(12, 17));
  // What is known of one reading screens those before it from those since.
  EXPECT_NEAR(errors(3, 30), errors(3, 11) * errors(11, 30), 1e-15);
}

TEST(ErrorsInTurn, OfAMeanAreTheMeanOverWhatItWasMadeOf) {
  std::vector<std::vector<Made>> made = made_in_turn(3);
  made[2] = {{.number = 2}, {.number = 7}};
  const Eigen::MatrixXd errors = errors_in_turn(made, 4.0);
  EXPECT_NEAR(errors(0, 2), 0.5 * (std::exp(-0.5) + std::exp(-1.75)), 1e-15);
  EXPECT_NEAR(errors(2, 2), 0.5 * (1.0 + std::exp(-1.25)), 1e-15);
}

TEST(FewTerms, LeaveOutATwentiethOfTheVarianceAtMost) {
  const Eigen::MatrixXd errors = errors_in_turn(made_in_turn(200), 30.0);
  const Eigen::MatrixXd terms = few_terms(errors);
  EXPECT_LT(terms.cols(), 100);
  const Eigen::MatrixXd left = errors - terms * terms.transpose();
  EXPECT_LE(left.diagonal().maxCoeff(), 0.05);
  EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(left).eigenvalues().minCoeff(), -1e-12);
}

}  // namespace
}  // namespace palpation
