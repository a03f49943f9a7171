#include "certainty/errors_in_turn.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace palpation {
namespace {

constexpr double kLeftOut = 0.05;  ///< of the largest variance

double alike(std::span<const Made> one, std::span<const Made> other, double readings) {
  double sum = 0.0;
  for (const Made& a : one) {
    for (const Made& b : other) {
      const auto [earlier, later] = std::minmax(a.number, b.number);
      sum += std::exp(-static_cast<double>(later - earlier) / readings);
    }
  }
  return sum / static_cast<double>(one.size() * other.size());
}

}  // namespace

Eigen::MatrixXd errors_in_turn(std::span<const std::vector<Made>> made, double readings) {
  const auto count = static_cast<Eigen::Index>(made.size());
  Eigen::MatrixXd errors(count, count);
  for (Eigen::Index a = 0; a < count; ++a) {
    for (Eigen::Index b = 0; b <= a; ++b)
      errors(a, b) = errors(b, a) =
          alike(made[static_cast<std::size_t>(a)], made[static_cast<std::size_t>(b)], readings);
  }
  return errors;
}

Eigen::MatrixXd few_terms(const Eigen::MatrixXd& covariance) {
  Eigen::VectorXd left = covariance.diagonal();
  Eigen::MatrixXd terms(covariance.rows(), covariance.cols());
  Eigen::Index count = 0, pivot = 0;
  if (left.size() == 0) return terms;
  for (const double most = left.maxCoeff(&pivot);
       count < terms.cols() && left[pivot] > kLeftOut * most; ++count) {
    const Eigen::RowVectorXd known = terms.row(pivot).head(count);
    terms.col(count) = (covariance.col(pivot) - terms.leftCols(count) * known.transpose()) /
                       std::sqrt(left[pivot]);
    left -= terms.col(count).cwiseAbs2();
    left.maxCoeff(&pivot);
  }
  return terms.leftCols(count);
}

}  // namespace palpation
