#include "belief/weight_space.h"

#include <Eigen/QR>
#include <algorithm>
#include <utility>

#include "base/tile.h"
#include "belief/aligned.h"
#include "palpation/base/parallel.h"

namespace palpation {

namespace {

/// I + F D F', D = diag(root)^2, its lower half.
Eigen::MatrixXd identity_and_squares(const Eigen::MatrixXd& features, const Eigen::VectorXd& root) {
  const auto rank = static_cast<int>(features.rows()), count = static_cast<int>(features.cols());
  const Eigen::MatrixXd minus = -features * root.asDiagonal();
  const PackedFactor rows(minus.data(), 1, rank, count, rank);
  const long given_per_tile = static_cast<long>(count) * kLanes,
             per_tile = static_cast<long>(rank) * kLanes;
  Eigen::MatrixXd result = Eigen::MatrixXd::Identity(rank, rank);
  for_ranges((rank + kLanes - 1) / kLanes, kTilesTogether, [&](int begin, int end) {
    const AlignedDoubles given =
        aligned_doubles(static_cast<std::size_t>((end - begin) * given_per_tile));
    const AlignedDoubles squares =
        aligned_doubles(static_cast<std::size_t>((end - begin) * per_tile));
    std::fill_n(given.get(), (end - begin) * given_per_tile, 0.0);
    std::fill_n(squares.get(), (end - begin) * per_tile, 0.0);
    const int last = std::min(rank, end * kLanes);
    for (int row = begin * kLanes; row < last; ++row) {
      double* lane = given.get() + (row / kLanes - begin) * given_per_tile + row % kLanes;
      for (int i = 0; i < count; ++i) lane[i * kLanes] = -minus(row, i);
    }
    subtract_product(rows, {given.get(), given_per_tile, count}, 0, end - begin, squares.get(),
                     per_tile);
    for (int column = begin * kLanes; column < last; ++column) {
      const double* lane = squares.get() + (column / kLanes - begin) * per_tile + column % kLanes;
      for (int row = column; row < rank; ++row) result(row, column) += lane[row * kLanes];
    }
  });
  return result;
}

}  // namespace

/// The weights by one step of refinement, whose residual needs no A; the whitened right sides as
/// [w; D^-1/2 (H - F' w)], whose squares add up without a difference.
WeightSpace::WeightSpace(const Eigen::MatrixXd& features, const Eigen::VectorXd& noise,
                         const Right& right) {
  const Eigen::Index rank = features.rows(), count = features.cols();
  const Eigen::VectorXd precision = noise.cwiseInverse();
  factor_.compute(identity_and_squares(features, precision.cwiseSqrt()));
  weights_ = Right::Zero(rank, 5);
  Right rest = right;
  for (int step = 0; step < 2; ++step) {
    weights_ += factor_.solve(features * (precision.asDiagonal() * rest) - weights_);
    rest = right - features.transpose() * weights_;
  }
  whitened_.resize(rank + count, 5);
  whitened_ << weights_, precision.cwiseSqrt().asDiagonal() * rest;
  log_determinant_ =
      2.0 * factor_.matrixLLT().diagonal().array().log().sum() + noise.array().log().sum();
}

/// S = D + F' A^-1 F of the new readings given the old, S = L L', t = L^-1 F' A^-1.
WeightSpace::Rows WeightSpace::append(const Eigen::MatrixXd& features, const Eigen::VectorXd& noise,
                                      const Right& right) {
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
  for (Eigen::Index i = 0; i < noise.size(); ++i)
    factor_.rankUpdate(features.col(i), 1.0 / noise[i]);
  return rows;
}

}  // namespace palpation
