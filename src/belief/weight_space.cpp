#include "belief/weight_space.h"

#include <Eigen/QR>
#include <utility>

namespace palpation {

/// The weights by one step of refinement, whose residual needs no A; the whitened right sides as [w; D^-1/2 (H - F' w)], whose squares add
/// up without a difference.
WeightSpace::WeightSpace(const Eigen::MatrixXd& features, const Eigen::VectorXd& noise, const Right& right) {
  const Eigen::Index rank = features.rows(), count = features.cols();
  const Eigen::VectorXd precision = noise.cwiseInverse();
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(rank, rank);
  a.selfadjointView<Eigen::Lower>().rankUpdate(features * precision.cwiseSqrt().asDiagonal());
  factor_.compute(a);
  weights_ = Right::Zero(rank, 5);
  Right rest = right;
  for (int step = 0; step < 2; ++step) {
    weights_ += factor_.solve(features * (precision.asDiagonal() * rest) - weights_);
    rest = right - features.transpose() * weights_;
  }
  whitened_.resize(rank + count, 5);
  whitened_ << weights_, precision.cwiseSqrt().asDiagonal() * rest;
  log_determinant_ = 2.0 * factor_.matrixLLT().diagonal().array().log().sum() + noise.array().log().sum();
}

/// S = D + F' A^-1 F of the new readings given the old, S = L L', t = L^-1 F' A^-1.
WeightSpace::Rows WeightSpace::append(const Eigen::MatrixXd& features, const Eigen::VectorXd& noise, const Right& right) {
  const Eigen::MatrixXd known = factor_.solve(features);
  Eigen::MatrixXd innovation = features.transpose() * known;
  innovation.diagonal() += noise;
  const Eigen::LLT<Eigen::MatrixXd> root(innovation);
  Rows rows = known.transpose();
  root.matrixL().solveInPlace(rows);
  Right fresh = right - features.transpose() * weights_;
  root.matrixL().solveInPlace(fresh);
  weights_.noalias() += rows.transpose() * fresh;
  Right whitened(whitened_.rows() + fresh.rows(), 5);
  whitened << whitened_, fresh;
  whitened_ = std::move(whitened);
  log_determinant_ += 2.0 * root.matrixLLT().diagonal().array().log().sum();
  for (Eigen::Index i = 0; i < noise.size(); ++i) factor_.rankUpdate(features.col(i), 1.0 / noise[i]);
  return rows;
}

}  // namespace palpation
