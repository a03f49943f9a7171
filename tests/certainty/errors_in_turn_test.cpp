#include "certainty/errors_in_turn.h"

#include <gtest/gtest.h>

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

TEST(ErrorsInTurn, OfEachReadingAreWithThoseThatWereMade) {
  const std::vector<std::vector<Made>> made = {{{.number = 2}, {.number = 7}}, {{.number = 9}}};
  const Eigen::MatrixXd errors = errors_at_each(12, made, 4.0);
  EXPECT_NEAR(errors(3, 0), 0.5 * (std::exp(-0.25) + std::exp(-1.0)), 1e-15);
  EXPECT_NEAR(errors(11, 1), std::exp(-0.5), 1e-15);
  const Eigen::VectorXd of_each = Eigen::VectorXd::LinSpaced(12, 0.0, 11.0);
  EXPECT_EQ(mean_in_turn(of_each, made), Eigen::Vector2d(4.5, 9.0));
}

// Of means of many readings here and there next to nothing is left: they are not where terms begin.
TEST(ErrorsInTurn, HaveTermsWhateverIsKnownFirst) {
  std::vector<std::vector<Made>> made = made_in_turn(200);
  for (std::size_t number = 0; number < 4000; number += 80) made[0].push_back({.number = number});
  EXPECT_GT(terms_of_errors(made, 10.0, 400).cols(), 50);
}

TEST(ErrorsInTurn, LastLongerWhereTheyWouldNeedTooManyTerms) {
  const std::vector<std::vector<Made>> made = made_in_turn(300);
  EXPECT_GT(terms_of_errors(made, 3.0, 300).cols(), 200);
  const Eigen::MatrixXd terms = terms_of_errors(made, 3.0, 60);
  EXPECT_LE(terms.cols(), 60);
  EXPECT_GE(terms.cols(), 40);
  // Errors of any reading are as high as before.
  EXPECT_GE(terms.rowwise().squaredNorm().minCoeff(), 0.95 - 1e-12);
  EXPECT_LE(terms.rowwise().squaredNorm().maxCoeff(), 1.0 + 1e-12);
}

}  // namespace
}  // namespace palpation
