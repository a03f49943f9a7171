/// A covariance as a product of few columns with themselves: the pivoted Cholesky decomposition
/// (Harbrecht, Peters and Schneider 2012).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace palpation {

struct FewTermsOptions {
  double left_out = 0.05;         ///< of the largest variance, at most
  Eigen::Index first_pivot = 0;   ///< the row that is known first
  Eigen::Index most = 1'000'000;  ///< columns
};

/// What one unit of each of few coefficients adds to each row.
struct FewTerms {
  Eigen::MatrixXd terms;
  std::vector<Eigen::Index> pivots;  ///< the row by which each column came
  bool is_whole = true;              ///< else so many columns leave out more
};

/// `variance`: of each row. `covariances_with`: of all rows with one of them.
FewTerms few_terms(const Eigen::VectorXd& variance,
                   const std::function<Eigen::VectorXd(Eigen::Index)>& covariances_with,
                   const FewTermsOptions& options = {});

/// Of a covariance that is at hand.
FewTerms few_terms(const Eigen::MatrixXd& covariance, const FewTermsOptions& options = {});

}  // namespace palpation
