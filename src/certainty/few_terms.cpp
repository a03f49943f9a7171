#include "certainty/few_terms.h"

#include <algorithm>
#include <cmath>

namespace palpation {

FewTerms few_terms(const Eigen::VectorXd& variance,
                   const std::function<Eigen::VectorXd(Eigen::Index)>& covariances_with,
                   const FewTermsOptions& options) {
  FewTerms few;
  if (variance.size() == 0) return few;
  const double least = options.left_out * variance.maxCoeff();
  Eigen::VectorXd left = variance;
  Eigen::MatrixXd& terms = few.terms;
  terms.resize(variance.size(), std::min(variance.size(), options.most));
  Eigen::Index count = 0;
  for (Eigen::Index pivot = options.first_pivot; left[pivot] > least; left.maxCoeff(&pivot)) {
    if (count == terms.cols()) {
      few.is_whole = false;
      break;
    }
    const Eigen::RowVectorXd known = terms.row(pivot).head(count);
    terms.col(count) = (covariances_with(pivot) - terms.leftCols(count) * known.transpose()) /
                       std::sqrt(left[pivot]);
    left -= terms.col(count++).cwiseAbs2();
    few.pivots.push_back(pivot);
  }
  terms.conservativeResize(Eigen::NoChange, count);
  return few;
}

FewTerms few_terms(const Eigen::MatrixXd& covariance, const FewTermsOptions& options) {
  return few_terms(
      covariance.diagonal(),
      [&](Eigen::Index row) -> Eigen::VectorXd { return covariance.col(row); }, options);
}

}  // namespace palpation
