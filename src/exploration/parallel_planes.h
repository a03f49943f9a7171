/// Readings as two plateaus that slope alike.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace palpation {

/// Slopes of two parallel planes that the values (n) at places (n x 2) lie on, but for one in ten
/// that may lie anywhere; those that are likelier than two level planes by `needed` nats, the
/// likeliest first, `most` at most. It is no matter how much of the tissue either plane holds, nor
/// what shape it has. Expectation and maximization, from slopes on a grid. Nothing for fewer than
/// ten values, or where all are alike.
std::vector<Eigen::Vector2d> slopes_of_parallel_planes(const Eigen::MatrixX2d& places,
                                                       const Eigen::VectorXd& values, double needed,
                                                       int most);

}  // namespace palpation
