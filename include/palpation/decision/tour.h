/// The order in which to visit the stops of a batch: a short open path from where the probe is.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace palpation {

/// distance: symmetric (n + 1) x (n + 1), row 0 the probe's place, rows 1..n the stops. Returns a
/// permutation of 0..n-1, the stops in the order of travel. Exact (Held and Karp 1962) up to 12
/// stops; beyond, nearest neighbour improved by 2-opt and Or-opt until neither helps. Ties go to
/// the lower index. Throws InvalidInput unless the matrix is square, finite, not negative and
/// symmetric to 1e-9 of its largest entry.
std::vector<int> shortest_tour(const Eigen::MatrixXd& distance);

/// Length of the open path 0 -> stops in order. Throws InvalidInput for a stop without a row.
double tour_length(const Eigen::MatrixXd& distance, const std::vector<int>& order);

}  // namespace palpation
