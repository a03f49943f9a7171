/// Linear regression on features, by which a posterior costs what their number asks and not the
/// number of readings:
///
///     y = H' b + f.w + noise,  w ~ N(0, I),  A = I + sum f f' / d,  cov(w | y) = A^-1,  mean(w |
///     y) = A^-1 sum f (y - H' b) / d,
///
/// d the noise of a reading over the signal's variance. What else is fitted (the constant, the
/// slope) is not known here: it is asked of the whitened right sides, whose inner products are
/// those with the inverse of F'F + D (Rasmussen and Williams 2006, 2.1.2 and 2.7).
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace palpation {

class WeightSpace {
 public:
  /// Right sides, one row a reading: 1, the reading, and the slope's three.
  using Right = Eigen::Matrix<double, Eigen::Dynamic, 5>;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// From many readings at once: `features` has one column for each.
  WeightSpace(const Eigen::MatrixXd& features, const Eigen::VectorXd& noise, const Right& right);

  /// A few more. Returns rows t such that t f is what they see of a place with features f, as L^-1
  /// k would be.
  Rows append(const Eigen::MatrixXd& features, const Eigen::VectorXd& noise, const Right& right);

  /// (I - A^-1) f: what is known of a place, in features.
  Eigen::VectorXd explained(const Eigen::VectorXd& features) const {
    return features - factor_.solve(features);
  }
  /// L with L L' = A.
  Rows factor() const { return factor_.matrixL(); }
  /// mean(w) for every right side, one a column.
  const Right& weights() const { return weights_; }
  const Right& whitened() const { return whitened_; }
  /// log |F'F + D|.
  double log_determinant() const { return log_determinant_; }

 private:
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Right weights_, whitened_;
  double log_determinant_ = 0.0;
};

}  // namespace palpation
