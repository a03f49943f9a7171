/// From any block of vectors to the slowest waves: filter, then the best within the span.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/start_block.h"

namespace palpation {

/// Share of the greatest eigenvalue wanted that the factor is shifted by. A greater one makes a
/// flatter filter: slow waves do not drown the quicker ones, whose span is then known to its last
/// digits, whatever is done to the mesh that changes rounding alone.
inline constexpr double kShift = 2.0;

/// Y <- T_(q-1)(2 S / s - 1) S Y with S = c (G + c M)^-1 M, s its eigenvalue where the filter ends,
/// q the number of solves.
void filter(std::vector<Strip>& block, const ShiftedLaplacian& laplacian, double end);

/// Y' A Y, by groups of strips whose products with A wait while all strips pass by.
Eigen::MatrixXd gram(const std::vector<Strip>& block, const Eigen::SparseMatrix<double>& a);

struct Ritz {
  Eigen::VectorXd values;
  Eigen::MatrixXd weights;  // of the block's vectors
};

/// The best modes within the span of vectors of which these are the products Y' G Y and Y' M Y.
Ritz ritz(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);

}  // namespace palpation
